#include "io/gltf/gltf.hpp"

#include "base/hash.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/nodes.hpp"

#include <fmt/format.h>

namespace facetmill::io {

namespace {

using namespace gltf;

class Speller {
  public:
    Speller(const Json& json, const Document& document)
        : json_(json), document_(document), source_(json, document.buffers) {}

    Json material(const JsonCursor& place) { return without_textures(place.json()); }

    Json animation(const JsonCursor& place) {
        Json out = place.json();
        if (const auto samplers = place.find("samplers"))
            for (std::size_t i = 0; i < samplers->size(); ++i)
                for (const char* key : {"input", "output"})
                    out["samplers"][i][key] = numbers(samplers->at(i).at(key));
        if (const auto channels = place.find("channels"))
            for (std::size_t i = 0; i < channels->size(); ++i)
                if (const auto node = channels->at(i).at("target").find("node"))
                    out["channels"][i]["target"]["node"] = name_of(*node);
        return out;
    }

    Json skin(const JsonCursor& place) {
        Json out = place.json();
        if (const auto matrices = place.find("inverseBindMatrices"))
            out["inverseBindMatrices"] = numbers(*matrices);
        if (const auto joints = place.find("joints"))
            for (std::size_t i = 0; i < joints->size(); ++i) out["joints"][i] = name_of(joints->at(i));
        if (const auto skeleton = place.find("skeleton")) out["skeleton"] = name_of(*skeleton);
        return out;
    }

  private:
    Json name_of(const JsonCursor& reference) const {
        const std::size_t i = reference.index(count_of(json_, "nodes"), "node");
        const std::string name = item(json_, "nodes", i).text_or("name", "");
        return name.empty() ? Json(i) : Json(name);
    }

    Json numbers(const JsonCursor& reference) {
        const Accessor a = accessor(source_, reference);
        const AttributeData data = decode(source_, a);
        return {
            {"count", a.count},
            {"components", a.components},
            {"sha256", std::visit([](const auto& v) { return sha256(std::as_bytes(std::span(v))); }, data)}};
    }

    Json image(const JsonCursor& reference) {
        const JsonCursor place = item(json_, "images", reference.index(count_of(json_, "images"), "image"));
        if (const auto uri = place.find("uri")) {
            if (is_data_uri(uri->text())) return sha256(data_uri_bytes(uri->text()));
            const auto file = document_.files.find(uri->text());
            return file == document_.files.end() ? "missing: " + uri->text() : sha256(file->second);
        }
        return sha256(source_.view(place.at("bufferView")));
    }

    Json texture(const JsonCursor& reference) {
        const JsonCursor place =
            item(json_, "textures", reference.index(count_of(json_, "textures"), "texture"));
        Json out = place.json();
        if (const auto source = place.find("source")) out["source"] = image(*source);
        if (const auto sampler = place.find("sampler"))
            out["sampler"] =
                item(json_, "samplers", sampler->index(count_of(json_, "samplers"), "sampler")).json();
        if (const auto extensions = place.find("extensions"))
            for (const auto& [name, value] : extensions->json().items())
                if (const auto source = JsonCursor(value, extensions->path() + "." + name).find("source"))
                    out["extensions"][name]["source"] = image(*source);
        return out;
    }

    /// Replaces each "...Texture" index by the texture itself.
    Json without_textures(Json json) {
        if (!json.is_object()) return json;
        for (auto& [key, value] : json.items()) {
            if (key == "extras") continue;
            if (key.ends_with("Texture") && value.is_object() && value.contains("index"))
                value["index"] = texture(JsonCursor(value, "materials." + key).at("index"));
            value = without_textures(std::move(value));
        }
        return json;
    }

    const Json& json_;
    const Document& document_;
    Source source_;
};

} // namespace

Json MaterialContents::of(const Material& material) {
    if (material.document < 0 || material.index < 0) return nullptr;
    const Document& document = *scene_.documents[static_cast<std::size_t>(material.document)];
    auto found = parsed_.find(material.document);
    if (found == parsed_.end())
        found = parsed_.emplace(material.document, parse_document(document.json)).first;
    const Json& json = found->second;
    Speller speller(json, document);
    return speller.material(item(json, "materials", static_cast<std::size_t>(material.index)));
}

Json document_contents(const Scene& scene) {
    const auto [base, json] = base_document(scene);
    if (base < 0) return nullptr;
    const Document& document = *scene.documents[static_cast<std::size_t>(base)];
    Speller speller(json, document);
    Json out = {{"animations", Json::array()},
                {"skins", Json::array()},
                {"cameras", json.value("cameras", Json::array())},
                {"lights", Json::array()}};
    for (std::size_t i = 0; i < count_of(json, "animations"); ++i)
        out["animations"].push_back(speller.animation(item(json, "animations", i)));
    for (std::size_t i = 0; i < count_of(json, "skins"); ++i)
        out["skins"].push_back(speller.skin(item(json, "skins", i)));
    if (const auto extensions = JsonCursor(json, "").find("extensions"))
        if (const auto lights = extensions->find("KHR_lights_punctual"))
            if (const auto entries = lights->find("lights")) out["lights"] = entries->json();
    return out;
}

} // namespace facetmill::io
