#include "io/gltf/write/join_documents.hpp"

#include "io/gltf/document/item_references.hpp"
#include "io/gltf/document/node_references.hpp"

#include <algorithm>

namespace facetmill::io::gltf {

std::size_t variant_number(Json& all, const Json& variant) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const Json& known) {
        return known.value("name", "") == variant.value("name", "");
    });
    const auto at = static_cast<std::size_t>(same - all.begin());
    if (same == all.end()) all.push_back(variant);
    return at;
}

namespace {

constexpr const char* lights_extension = "KHR_lights_punctual";

/// The lists that a document appends to another.
constexpr const char* appended_lists[] = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                          "images",    "materials",  "meshes",  "nodes",       "samplers",
                                          "scenes",    "skins",      "textures"};

const Json* member_of(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

/// An item list of an extension of the document; null without one.
Json* root_list(Json& document, const char* extension, const char* list) {
    const Json::json_pointer place = Json::json_pointer("/extensions") / extension / list;
    return document.contains(place) && document[place].is_array() ? &document[place] : nullptr;
}

/// True if all references of the document are known, and can be renumbered.
bool is_joinable(const Json& document) {
    if (has_unknown_extensions(document) || uses_extension(document, "KHR_animation_pointer") ||
        uses_extension(document, "EXT_lights_image_based") || uses_extension(document, "KHR_xmp_json_ld"))
        return false;
    const Json* extensions = member_of(document, "extensions");
    if (!extensions) return true;
    return std::all_of(extensions->items().begin(), extensions->items().end(), [](const auto& extension) {
        return extension.key() == lights_extension || extension.key() == variants_extension;
    });
}

/// True if the scene still needs the document's nodes: it has parts of them, or they never had meshes.
bool is_in_use(const Scene& scene, int document, const Json& json) {
    if (!json.contains("nodes")) return false;
    return count_of(json, "meshes") == 0 ||
           std::any_of(scene.parts.begin(), scene.parts.end(),
                       [&](const Part& part) { return part.document == document; });
}

/// The offsets to add to the item numbers of a document, and the new numbers of its variants.
struct Renumbering {
    std::map<std::string, std::size_t> first{}; ///< by list
    std::size_t first_light = 0;
    std::vector<std::size_t> variants{};
};

/// Renumbers the variants of a primitive, and the materials and textures that its extensions name.
void renumber_primitive_extensions(Json& primitive, const Renumbering& by) {
    visit_texture_references(primitive, [&](Json& r) { r = r.get<std::size_t>() + by.first.at("textures"); });
    const Json::json_pointer place("/extensions/KHR_materials_variants/mappings");
    if (!primitive.contains(place) || !primitive[place].is_array()) return;
    for (Json& mapping : primitive[place]) {
        if (index_at(mapping, "material"))
            mapping["material"] = mapping["material"].get<std::size_t>() + by.first.at("materials");
        if (!member_of(mapping, "variants")) continue;
        for (Json& variant : mapping["variants"])
            if (variant.is_number_unsigned() && variant.get<std::size_t>() < by.variants.size())
                variant = by.variants[variant.get<std::size_t>()];
    }
}

void shift_member(Json& object, const char* key, std::size_t by) {
    if (index_at(object, key)) object[key] = object[key].get<std::size_t>() + by;
}

void renumber_views(Json& document, const Renumbering& by) {
    for (std::size_t v = 0; v < count_of(document, "bufferViews"); ++v) {
        Json& view = document["bufferViews"][v];
        shift_member(view, "buffer", by.first.at("buffers"));
        for (const char* name : meshopt_names)
            if (const Json::json_pointer place = Json::json_pointer("/extensions") / name;
                view.contains(place))
                shift_member(view[place], "buffer", by.first.at("buffers"));
    }
}

void renumber(Json& document, const Renumbering& by) {
    using Visit = std::function<void(Json&)>;
    const auto shift = [&](const char* list) {
        return Visit([add = by.first.at(list)](Json& r) { r = r.get<std::size_t>() + add; });
    };
    visit_accessor_references(document, shift("accessors"));
    visit_view_references(document, shift("bufferViews"));
    visit_mesh_references(document, shift("meshes"));
    visit_image_references(document, shift("images"));
    visit_sampler_references(document, shift("samplers"));
    visit_material_references(document, shift("materials"));
    visit_node_references(document, shift("nodes"));
    for (std::size_t m = 0; m < count_of(document, "materials"); ++m)
        visit_texture_references(document["materials"][m], shift("textures"));
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m)
        for (Json& primitive : document["meshes"][m]["primitives"])
            renumber_primitive_extensions(primitive, by);
    renumber_views(document, by);
    const Json::json_pointer light("/extensions/KHR_lights_punctual");
    for (std::size_t n = 0; n < count_of(document, "nodes"); ++n) {
        Json& node = document["nodes"][n];
        shift_member(node, "skin", by.first.at("skins"));
        shift_member(node, "camera", by.first.at("cameras"));
        if (node.contains(light)) shift_member(node[light], "light", by.first_light);
    }
}

/// Gives a document without scenes one that shows all its roots.
void give_scene(Json& document) {
    if (count_of(document, "scenes") > 0 || count_of(document, "nodes") == 0) return;
    Json roots = Json::array();
    const auto frames = node_frames(document);
    for (std::size_t n = 0; n < frames.size(); ++n)
        if (frames[n].parent < 0) roots.push_back(n);
    document["scenes"] = Json::array({Json{{"nodes", std::move(roots)}}});
    document["scene"] = 0;
}

/// Adds the items to the lights or the variants of the document.
void append_lights(Json& document, Json& other) {
    const Json* lights = root_list(other, lights_extension, "lights");
    if (!lights) return;
    Json& all = document["extensions"][lights_extension]["lights"];
    if (!all.is_array()) all = Json::array();
    for (const Json& light : *lights) all.push_back(light);
}

/// Adds variants whose names are new. Returns the number of each.
std::vector<std::size_t> append_variants(Json& document, Json& other) {
    std::vector<std::size_t> numbers;
    const Json* variants = root_list(other, variants_extension, "variants");
    if (!variants) return numbers;
    Json& all = document["extensions"][variants_extension]["variants"];
    if (!all.is_array()) all = Json::array();
    for (const Json& variant : *variants) numbers.push_back(variant_number(all, variant));
    return numbers;
}

/// Adds the nodes of the other document's scene to the document's scene. Other scenes stay.
void append_scenes(Json& document, Json& other) {
    const std::size_t shown = index_at(document, "scene", document["scenes"].size()).value_or(0);
    const std::size_t theirs = index_at(other, "scene", other["scenes"].size()).value_or(0);
    for (std::size_t s = 0; s < other["scenes"].size(); ++s) {
        Json& scene = other["scenes"][s];
        if (s != theirs) {
            document["scenes"].push_back(std::move(scene));
            continue;
        }
        Json& into = document["scenes"][shown];
        if (!into["nodes"].is_array()) into["nodes"] = Json::array();
        if (member_of(scene, "nodes"))
            for (const Json& node : scene["nodes"]) into["nodes"].push_back(node);
        if (scene.contains("extras") && !into.contains("extras")) into["extras"] = scene["extras"];
        if (into["nodes"].empty()) into.erase("nodes");
    }
}

void append(Json& document, Json& other, const Renumbering& by) {
    renumber(other, by);
    append_lights(document, other);
    for (const char* list : appended_lists) {
        if (list == std::string_view("scenes") || count_of(other, list) == 0) continue;
        if (!document[list].is_array()) document[list] = Json::array();
        for (Json& item : other[list]) document[list].push_back(std::move(item));
    }
    append_scenes(document, other);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        if (const Json* names = member_of(other, list); names && names->is_array())
            for (const Json& name : *names)
                if (name.is_string()) add_name(document, list, name.get<std::string>());
    if (other.contains("extras") && !document.contains("extras")) document["extras"] = other["extras"];
}

/// Moves the parts and materials of an appended document to the base document.
void follow_document(Scene& scene, int from, int to, const Renumbering& by) {
    for (Part& part : scene.parts) {
        if (part.document != from) continue;
        part.document = to;
        if (part.node >= 0) part.node += static_cast<int>(by.first.at("nodes"));
        if (part.source_mesh >= 0) part.source_mesh += static_cast<int>(by.first.at("meshes"));
        for (Primitive& primitive : part.mesh.primitives) {
            if (primitive.json.empty()) continue;
            Json json = parse_document(primitive.json);
            renumber_primitive_extensions(json, by);
            primitive.json = to_string(json);
        }
    }
    for (Material& material : scene.materials) {
        if (material.document != from) continue;
        material.document = to;
        if (material.index >= 0) material.index += static_cast<int>(by.first.at("materials"));
    }
}

} // namespace

std::optional<JoinedDocuments> join_documents(const Scene& scene, const BaseDocument& base) {
    if (base.index < 0 || scene.documents.size() < 2) return {};
    std::optional<JoinedDocuments> out;
    std::shared_ptr<facetmill::Document> document;
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        const int number = static_cast<int>(d);
        if (number == base.index) continue;
        Json other = parse_document(scene.documents[d]->json);
        if (!is_in_use(scene, number, other) || !is_joinable(other)) continue;
        if (!out) {
            const auto b = static_cast<std::size_t>(base.index);
            document = std::make_shared<facetmill::Document>(*scene.documents[b]);
            out = JoinedDocuments{scene, base.json};
            give_scene(out->json);
            out->scene.documents[b] = document;
        }
        give_scene(other);
        Renumbering by;
        for (const char* list : appended_lists) by.first[list] = count_of(out->json, list);
        if (const Json* lights = root_list(out->json, lights_extension, "lights"))
            by.first_light = lights->size();
        by.variants = append_variants(out->json, other);
        for (std::size_t i = 0; i < count_of(other, "images"); ++i)
            out->images[by.first["images"] + i] = number;
        append(out->json, other, by);
        follow_document(out->scene, number, base.index, by);
        const auto& buffers = scene.documents[d]->buffers;
        document->buffers.resize(by.first["buffers"]);
        document->buffers.insert(document->buffers.end(), buffers.begin(), buffers.end());
        out->joined.insert(number);
    }
    if (out) document->json = to_string(out->json);
    return out;
}

} // namespace facetmill::io::gltf
