#include "io/gltf/document/item_references.hpp"
#include "io/gltf/write/join_documents.hpp"
#include "io/gltf/write/patch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

enum : std::size_t { kind_texture, kind_image, kind_sampler, kinds };

const Json& other_document(MaterialCopies& copies, int document) {
    auto found = copies.others.find(document);
    if (found == copies.others.end())
        found = copies.others
                    .emplace(document,
                             parse_document(
                                 copies.patch.scene.documents[static_cast<std::size_t>(document)]->json))
                    .first;
    return found->second;
}

/// Calls `copy` the first time that item i of a kind and a document is requested, and remembers the new
/// index.
template <class Copy>
std::size_t once(MaterialCopies& copies, int document, std::size_t kind, std::size_t i, Copy&& copy) {
    const auto key = std::pair(document, i * kinds + kind);
    if (const auto known = copies.copied.find(key); known != copies.copied.end()) return known->second;
    const std::size_t index = copy();
    copies.copied[key] = index;
    return index;
}

std::size_t copy_image(MaterialCopies& copies, int document, std::size_t i) {
    const Json& other = other_document(copies, document);
    Json image = item(other, "images", i).json();
    if (image.contains("bufferView")) {
        Source source(other, copies.patch.scene.documents[static_cast<std::size_t>(document)]->buffers);
        const Span bytes = source.view(item(other, "images", i).at("bufferView"));
        image["bufferView"] = copies.patch.builder.add_view(Bytes(bytes.begin(), bytes.end()));
    }
    const std::size_t index = copies.patch.builder.add("images", std::move(image));
    copies.images[index] = document;
    return index;
}

std::size_t image_for(MaterialCopies& copies, int document, const JsonCursor& reference) {
    const std::size_t i = reference.index(count_of(other_document(copies, document), "images"), "image");
    return once(copies, document, kind_image, i, [&] { return copy_image(copies, document, i); });
}

std::size_t copy_texture(MaterialCopies& copies, int document, std::size_t i) {
    const Json& other = other_document(copies, document);
    const JsonCursor place = item(other, "textures", i);
    Json texture = place.json();
    if (const auto source = place.find("source")) texture["source"] = image_for(copies, document, *source);
    if (const auto sampler = place.find("sampler")) {
        const std::size_t s = sampler->index(count_of(other, "samplers"), "sampler");
        texture["sampler"] = once(copies, document, kind_sampler, s, [&] {
            return copies.patch.builder.add("samplers", item(other, "samplers", s).json());
        });
    }
    if (const auto extensions = place.find("extensions"))
        for (const auto& [name, value] : extensions->json().items())
            if (const auto source = JsonCursor(value, extensions->path() + "." + name).find("source")) {
                texture["extensions"][name]["source"] = image_for(copies, document, *source);
                copies.patch.builder.use_extension(name, !texture.contains("source"));
            }
    return copies.patch.builder.add("textures", std::move(texture));
}

/// Renumbers the textures of a material and its extensions: every "...Texture" with an index.
void copy_textures(MaterialCopies& copies, int document, Json& json) {
    if (!json.is_object()) return;
    for (auto& [key, value] : json.items()) {
        if (key == "extras") continue;
        const std::string name = key;
        const bool texture = name.size() >= 7 && name.compare(name.size() - 7, 7, "Texture") == 0;
        if (texture && value.is_object() && value.contains("index")) {
            const Json& other = other_document(copies, document);
            const std::size_t i =
                JsonCursor(value, "materials").at("index").index(count_of(other, "textures"), "texture");
            value["index"] =
                once(copies, document, kind_texture, i, [&] { return copy_texture(copies, document, i); });
        }
        if (name == "extensions" && value.is_object())
            for (const auto& [extension, content] : value.items())
                copies.patch.builder.use_extension(extension, false);
        copy_textures(copies, document, value);
    }
}

/// Drops the levels of detail of a material, whose numbers are of the other document. Warns.
void copy_levels(MaterialCopies& copies, int document, Json& json) {
    const auto extensions = json.find("extensions");
    if (extensions == json.end() || !extensions->is_object() || extensions->erase("MSFT_lod") == 0) return;
    if (extensions->empty()) json.erase("extensions");
    const std::string& name = copies.patch.scene.documents[static_cast<std::size_t>(document)]->name;
    copies.patch.warn("W-MERGED",
                      fmt::format("the levels of detail of material '{}' of '{}' are not written",
                                  json.value("name", std::string()), name),
                      fmt::format("load '{}' alone, and write it to a separate file to keep them", name));
}

Json new_material(const Material& material) {
    Json json = Json::object();
    if (!material.name.empty()) json["name"] = material.name;
    // glTF's default is metal, which other formats do not intend.
    json["pbrMetallicRoughness"] = {{"baseColorFactor", Json::array()}, {"metallicFactor", 0}};
    for (const double c : material.base_colour)
        json["pbrMetallicRoughness"]["baseColorFactor"].push_back(std::clamp(c, 0.0, 1.0));
    if (material.double_sided) json["doubleSided"] = true;
    return json;
}

/// Stages may change whether a material is double-sided; the rest of a document's material is unchanged.
void patch_sides(const Material& material, Json& json) {
    if (json.value("doubleSided", false) != material.double_sided)
        json["doubleSided"] = material.double_sided;
}

/// The number of the variant of another document in the document that is written, added by its name if new.
std::optional<std::size_t> variant_for(MaterialCopies& copies, const Json& other, const Json& number) {
    const Json::json_pointer place("/extensions/KHR_materials_variants/variants");
    if (!number.is_number_unsigned() || !other.contains(place) ||
        number.get<std::size_t>() >= other[place].size())
        return {};
    const Json& variant = other[place][number.get<std::size_t>()];
    copies.patch.builder.use_extension(variants_extension, false);
    Json& all = copies.patch.builder.json()["extensions"][variants_extension]["variants"];
    if (!all.is_array()) all = Json::array();
    return variant_number(all, variant);
}

/// The scene's material with this number in a document; none if a stage has removed it.
Index material_of(const Scene& scene, int document, std::size_t number) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
        return m.document == document && m.index >= 0 && static_cast<std::size_t>(m.index) == number;
    });
    return found == scene.materials.end() ? none : static_cast<Index>(found - scene.materials.begin());
}

} // namespace

Json patch_variants(MaterialCopies& copies, const Primitive& primitive, int document, const Json& extension) {
    const Scene& scene = copies.patch.scene;
    if (primitive.material < scene.materials.size() && scene.materials[primitive.material].document >= 0)
        document = scene.materials[primitive.material].document;
    if (document < 0) return nullptr;
    if (document == copies.patch.base) {
        const Json& json = copies.patch.builder.json();
        return json.contains("extensions") && json["extensions"].contains(variants_extension) ? extension
                                                                                              : Json();
    }
    const Json& other = other_document(copies, document);
    Json mappings = Json::array();
    for (const Json& mapping : extension.value("mappings", Json::array())) {
        const auto number = index_at(mapping, "material");
        const Index material = number ? material_of(scene, document, *number) : none;
        Json variants = Json::array();
        if (material != none)
            for (const Json& variant : mapping.value("variants", Json::array()))
                if (const auto at = variant_for(copies, other, variant)) variants.push_back(*at);
        if (variants.empty()) continue;
        Json own = mapping;
        own["variants"] = std::move(variants);
        own["material"] = patch_material(copies, material);
        mappings.push_back(std::move(own));
    }
    if (mappings.empty()) return nullptr;
    Json own = extension;
    own["mappings"] = std::move(mappings);
    return own;
}

int patch_material(MaterialCopies& copies, Index index) {
    if (index >= copies.patch.scene.materials.size()) return -1;
    const Material& material = copies.patch.scene.materials[index];
    if (material.document >= 0 && material.document == copies.patch.base && material.index >= 0) {
        patch_sides(material,
                    copies.patch.builder.json()["materials"][static_cast<std::size_t>(material.index)]);
        return material.index;
    }
    if (const auto known = copies.materials.find(index); known != copies.materials.end())
        return known->second;
    Json json;
    if (material.document >= 0 && material.index >= 0) {
        const Json& other = other_document(copies, material.document);
        json = item(other, "materials", static_cast<std::size_t>(material.index)).json();
        copy_levels(copies, material.document, json);
        copy_textures(copies, material.document, json);
        patch_sides(material, json);
    } else {
        json = new_material(material);
    }
    return copies.materials[index] = static_cast<int>(copies.patch.builder.add("materials", std::move(json)));
}

} // namespace facetmill::io::gltf
