#include "io/gltf/builder.hpp"

namespace facetmill::io::gltf {

namespace {

using Visit = std::function<void(Json&)>;

/// The member of an object, or null when there is none.
Json* member(Json* object, const char* key) {
    if (!object || !object->is_object()) return nullptr;
    const auto it = object->find(key);
    return it == object->end() ? nullptr : &*it;
}

Json* extension(Json* object, const char* name) { return member(member(object, "extensions"), name); }

void each(Json* list, const Visit& visit) {
    if (list && list->is_array())
        for (auto& value : *list) visit(value);
}

void reference(Json* value, const Visit& visit) {
    if (value && value->is_number()) visit(*value);
}

void all_members(Json* object, const Visit& visit) {
    if (object && object->is_object())
        for (auto& [key, value] : object->items()) reference(&value, visit);
}

void primitive_accessors(Json& primitive, const Visit& visit) {
    reference(member(&primitive, "indices"), visit);
    all_members(member(&primitive, "attributes"), visit);
    each(member(&primitive, "targets"), [&](Json& target) { all_members(&target, visit); });
}

bool known(const std::string& name) {
    static const std::set<std::string> names = {"KHR_draco_mesh_compression",
                                                "KHR_mesh_quantization",
                                                "EXT_meshopt_compression",
                                                "EXT_mesh_manifold",
                                                "EXT_mesh_gpu_instancing",
                                                "KHR_lights_punctual",
                                                "KHR_xmp_json_ld",
                                                "KHR_node_visibility",
                                                "MSFT_lod",
                                                "MSFT_texture_dds",
                                                "EXT_lights_image_based"};
    const auto starts = [&](const char* prefix) { return name.rfind(prefix, 0) == 0; };
    return names.count(name) > 0 || starts("KHR_materials_") || starts("KHR_texture_") ||
           starts("EXT_texture_");
}

} // namespace

void visit_accessor_references(Json& document, const Visit& visit) {
    each(member(&document, "meshes"), [&](Json& mesh) {
        each(member(&mesh, "primitives"), [&](Json& p) { primitive_accessors(p, visit); });
        if (Json* manifold = extension(&mesh, "EXT_mesh_manifold")) {
            if (Json* p = member(manifold, "manifoldPrimitive")) primitive_accessors(*p, visit);
            reference(member(manifold, "mergeIndices"), visit);
            reference(member(manifold, "mergeValues"), visit);
        }
    });
    each(member(&document, "animations"), [&](Json& animation) {
        each(member(&animation, "samplers"), [&](Json& sampler) {
            reference(member(&sampler, "input"), visit);
            reference(member(&sampler, "output"), visit);
        });
    });
    each(member(&document, "skins"),
         [&](Json& skin) { reference(member(&skin, "inverseBindMatrices"), visit); });
    each(member(&document, "nodes"), [&](Json& node) {
        all_members(member(extension(&node, "EXT_mesh_gpu_instancing"), "attributes"), visit);
    });
}

void visit_view_references(Json& document, const Visit& visit) {
    each(member(&document, "accessors"), [&](Json& accessor) {
        reference(member(&accessor, "bufferView"), visit);
        Json* sparse = member(&accessor, "sparse");
        reference(member(member(sparse, "indices"), "bufferView"), visit);
        reference(member(member(sparse, "values"), "bufferView"), visit);
    });
    each(member(&document, "images"), [&](Json& image) { reference(member(&image, "bufferView"), visit); });
    each(member(&document, "meshes"), [&](Json& mesh) {
        each(member(&mesh, "primitives"), [&](Json& p) {
            reference(member(extension(&p, "KHR_draco_mesh_compression"), "bufferView"), visit);
        });
    });
}

void visit_mesh_references(Json& document, const Visit& visit) {
    each(member(&document, "nodes"), [&](Json& node) { reference(member(&node, "mesh"), visit); });
}

bool has_unknown_extensions(const Json& json) {
    if (json.is_object()) {
        for (const auto& [key, value] : json.items()) {
            if (key == "extras") continue;
            if (key == "extensions" && value.is_object())
                for (const auto& [name, content] : value.items())
                    if (!known(name)) return true;
            if (has_unknown_extensions(value)) return true;
        }
    } else if (json.is_array()) {
        for (const auto& value : json)
            if (value.is_structured() && has_unknown_extensions(value)) return true;
    }
    return false;
}

void erase_items(Json& list, const std::set<std::size_t>& items,
                 const std::function<void(const std::function<void(Json&)>&)>& references) {
    if (items.empty()) return;
    std::vector<std::size_t> number;
    Json kept = Json::array();
    for (std::size_t i = 0; i < list.size(); ++i) {
        number.push_back(kept.size());
        if (!items.count(i)) kept.push_back(std::move(list[i]));
    }
    list = std::move(kept);
    references([&](Json& reference) {
        const auto old = reference.get<std::size_t>();
        if (old < number.size()) reference = number[old];
    });
}

} // namespace facetmill::io::gltf
