#include "io/gltf/document/item_references.hpp"

#include <string_view>

namespace facetmill::io::gltf {

namespace {

using Visit = std::function<void(Json&)>;

/// Calls visit for references in members of the objects of a list: list[i][key].
void visit_members(Json& document, const char* list, const char* key, const Visit& visit) {
    if (!document.contains(list)) return;
    for (Json& item : document[list])
        if (index_at(item, key)) visit(item[key]);
}

} // namespace

void visit_texture_references(Json& json, const Visit& visit) {
    if (!json.is_structured()) return;
    for (auto& [key, value] : json.items()) {
        if (key == "extras") continue;
        const bool texture = std::string_view(key).ends_with("Texture") || key == "texture" ||
                             (value.is_object() && value.contains("channels"));
        if (texture && index_at(value, "index")) visit(value["index"]);
        visit_texture_references(value, visit);
    }
}

void visit_image_references(Json& document, const Visit& visit) {
    visit_members(document, "textures", "source", visit);
    if (!document.contains("textures")) return;
    for (Json& texture : document["textures"])
        if (texture.is_object() && texture.contains("extensions"))
            for (auto& [name, value] : texture["extensions"].items())
                if (index_at(value, "source")) visit(value["source"]);
}

void visit_material_references(Json& document, const Visit& visit) {
    const Json::json_pointer levels("/extensions/MSFT_lod/ids");
    for (std::size_t m = 0; m < count_of(document, "materials"); ++m) {
        Json& material = document["materials"][m];
        if (material.is_object() && material.contains(levels) && material[levels].is_array())
            for (Json& level : material[levels])
                if (level.is_number_unsigned()) visit(level);
    }
    if (!document.contains("meshes")) return;
    for (Json& mesh : document["meshes"])
        for (Json& primitive : mesh["primitives"])
            if (index_at(primitive, "material")) visit(primitive["material"]);
}

void visit_sampler_references(Json& document, const Visit& visit) {
    visit_members(document, "textures", "sampler", visit);
}

} // namespace facetmill::io::gltf
