#include "io/material_document.hpp"

#include "base/hash.hpp"
#include "base/ordered_set.hpp"
#include "io/images/image_files.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

MaterialDocument::MaterialDocument(std::string name)
    : json_{{"asset", {{"version", "2.0"}}}, {"materials", Json::array()}} {
    document_.name = std::move(name);
}

std::size_t MaterialDocument::find_or_add(const char* list, const Json& value) {
    Json& items = json_[list];
    if (!items.is_array()) items = Json::array();
    const auto found = std::find(items.begin(), items.end(), value);
    const auto index = static_cast<std::size_t>(found - items.begin());
    if (found == items.end()) items.push_back(value);
    return index;
}

std::size_t MaterialDocument::texture(const std::filesystem::path& image, const std::vector<std::byte>& bytes,
                                      bool clamp, bool is_file, bool nearest) {
    constexpr int repeat = 10497, clamp_to_edge = 33071;
    std::filesystem::path path = image;
    std::string uri = uri_of(path);
    for (int n = 2; !document_.files.try_emplace(uri, bytes).second && document_.files[uri] != bytes; ++n) {
        path = image.parent_path() /
               fmt::format("{}.{}{}", image.stem().generic_string(), n, image.extension().generic_string());
        uri = uri_of(path);
    }
    const int wrap = clamp ? clamp_to_edge : repeat;
    Json sampling = {{"wrapS", wrap}, {"wrapT", wrap}};
    if (nearest) sampling["magFilter"] = sampling["minFilter"] = 9728;
    const std::size_t sampler = find_or_add("samplers", sampling);
    const std::size_t source = find_or_add("images", {{"uri", uri}});
    if (source == images_.size()) images_.push_back({path, "", is_file && path == image});
    return find_or_add("textures", {{"sampler", sampler}, {"source", source}});
}

void MaterialDocument::list_extensions(const Json& json) {
    if (!json.is_structured()) return;
    for (const auto& [key, value] : json.items()) {
        if (json.is_object() && key == "extensions")
            for (const auto& [name, content] : value.items()) find_or_add("extensionsUsed", name);
        list_extensions(value);
    }
}

Material MaterialDocument::add(Json material, std::size_t documents) {
    list_extensions(material);
    Material out;
    out.name = material.value("name", "");
    out.double_sided = material.value("doubleSided", false);
    const Json colour = material.value(Json::json_pointer("/pbrMetallicRoughness/baseColorFactor"),
                                       Json::array({1, 1, 1, 1}));
    for (std::size_t c = 0; c < 4; ++c) out.base_colour[c] = colour.at(c).get<double>();
    out.document = static_cast<int>(documents);
    out.index = static_cast<int>(json_["materials"].size());
    json_["materials"].push_back(std::move(material));
    return out;
}

namespace {

/// Adds the textures of a material in the order in which a written document copies them.
void add_textures(const Json& json, std::vector<std::size_t>& textures) {
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
        if (key.ends_with("Texture") && value.is_object() && value.contains("index"))
            textures.push_back(value["index"].get<std::size_t>());
        add_textures(value, textures);
    }
}

} // namespace

std::vector<std::size_t> images_of_materials(const Json& document) {
    std::vector<std::size_t> textures;
    for (const auto& material : document.at("materials")) add_textures(material, textures);
    OrderedSet<std::size_t> images;
    for (const std::size_t texture : textures)
        images.add(document.at("textures").at(texture).at("source").get<std::size_t>());
    return images.all();
}

std::vector<NamedImage> MaterialDocument::images() const {
    std::vector<NamedImage> all;
    for (const std::size_t i : images_of_materials(json_)) {
        all.push_back(images_[i]);
        all.back().digest = sha256(document_.files.at(json_["images"][i]["uri"].get<std::string>()));
    }
    return all;
}

std::shared_ptr<const Document> MaterialDocument::finish() {
    document_.json = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    return std::make_shared<const Document>(std::move(document_));
}

} // namespace facetmill::io
