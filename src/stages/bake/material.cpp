#include "stages/bake/material.hpp"

#include "base/json.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "io/images/encode_image.hpp"
#include "io/material_document.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>

namespace facetmill::bake_stage {

namespace {

io::Pixels pixels_of(const BakedMaps& maps, const std::vector<std::uint8_t>& rgba) {
    const auto side = static_cast<std::size_t>(maps.size);
    return {side, side, rgba, false};
}

/// Whether all bytes of a channel are the same.
bool is_uniform(const std::vector<std::uint8_t>& rgba, std::size_t channel) {
    for (std::size_t i = channel; i < rgba.size(); i += 4)
        if (rgba[i] != rgba[channel]) return false;
    return true;
}

struct Map {
    const char* name; ///< in glTF
    const char* file;
    const std::vector<std::uint8_t>* rgba;
    io::Bytes png{};
};

bool all_unlit(const BakeSource& source) {
    return !source.looks.empty() && std::all_of(source.looks.begin(), source.looks.end(),
                                                [](const MaterialLook& look) { return look.unlit; });
}

/// OPAQUE, MASK or BLEND, as the looks of the source need it.
const char* alpha_mode(const BakeSource& source, const BakedMaps& maps) {
    if (!maps.transparent) return "OPAQUE";
    for (const MaterialLook& look : source.looks)
        if (look.alpha == MaterialLook::Alpha::blend) return "BLEND";
    return "MASK";
}

std::vector<Map> maps_of(const BakeSource& source, const BakedMaps& maps) {
    std::vector<Map> all = {{"baseColorTexture", "base_colour.png", &maps.base}};
    if (!all_unlit(source)) {
        all.push_back({"normalTexture", "normal.png", &maps.normal});
        const bool plain =
            is_uniform(maps.surface, 0) && is_uniform(maps.surface, 1) && is_uniform(maps.surface, 2);
        if (!plain) all.push_back({"metallicRoughnessTexture", "surface.png", &maps.surface});
        if (maps.glows) all.push_back({"emissiveTexture", "emission.png", &maps.emission});
    }
    parallel_for(
        all.size(),
        [&](std::size_t i) { all[i].png = io::encoded_png_quickly(pixels_of(maps, *all[i].rgba)); }, 1);
    return all;
}

Json material_json(const BakeSource& source, const BakedMaps& maps, const std::vector<Map>& all,
                   io::MaterialDocument& document) {
    Json json = {{"name", "baked"}, {"pbrMetallicRoughness", Json::object()}};
    Json pbr = Json::object();
    pbr["metallicFactor"] = static_cast<double>(maps.surface[2]) / 255;
    pbr["roughnessFactor"] = static_cast<double>(maps.surface[1]) / 255;
    for (const Map& map : all) {
        const Json texture = {{"index", document.texture(map.file, map.png, true, false)}};
        const std::string name = map.name;
        if (name == "metallicRoughnessTexture") {
            pbr["metallicFactor"] = pbr["roughnessFactor"] = 1;
            pbr[name] = texture;
            if (!is_uniform(maps.surface, 0)) json["occlusionTexture"] = texture;
        } else if (name == "baseColorTexture") {
            pbr[name] = texture;
        } else {
            json[name] = texture;
        }
    }
    json["pbrMetallicRoughness"] = std::move(pbr);
    const bool glows = maps.glows && !all_unlit(source);
    if (glows) json["emissiveFactor"] = Json::array({1, 1, 1});
    if (glows && maps.emission_strength > 1)
        json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = maps.emission_strength;
    if (all_unlit(source)) json["extensions"]["KHR_materials_unlit"] = Json::object();
    const std::string mode = alpha_mode(source, maps);
    if (mode != "OPAQUE") json["alphaMode"] = mode;
    if (std::find(source.double_sided.begin(), source.double_sided.end(), 1) != source.double_sided.end())
        json["doubleSided"] = true;
    return json;
}

void use_material(Mesh& mesh, Index material) {
    mesh.drop(primitive_attribute, Domain::face);
    mesh.primitives.assign(1, {});
    mesh.primitives[0].material = material;
    mesh.line_primitive.clear();
    std::erase_if(mesh.attributes, [](const Attribute& a) { return a.role == Role::colour; });
}

/// The document without the materials of its meshes' primitives.
Document without_materials(const Document& document) {
    Document out = document;
    Json json = Json::parse(document.json);
    if (json.contains("meshes") && json["meshes"].is_array())
        for (Json& mesh : json["meshes"]) {
            if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
            for (Json& primitive : mesh["primitives"])
                if (primitive.is_object()) primitive.erase("material");
        }
    out.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return out;
}

} // namespace

BakedMaterial put_material(Scene& scene, const std::vector<std::size_t>& parts, const BakeSource& source,
                           const BakedMaps& maps) {
    const std::vector<Map> all = maps_of(source, maps);
    io::MaterialDocument document("baked");
    Json json = material_json(source, maps, all, document);
    scene.materials.push_back(document.add(std::move(json), scene.documents.size()));
    scene.documents.push_back(document.finish());
    for (const std::size_t i : parts)
        use_material(scene.parts[i].mesh, static_cast<Index>(scene.materials.size() - 1));
    BakedMaterial out;
    for (const Map& map : all) {
        out.maps.emplace_back(map.name);
        out.bytes += map.png.size();
    }
    return out;
}

void drop_unused_materials(Scene& scene) {
    std::vector<std::uint8_t> used(scene.documents.size());
    for (const Part& part : scene.parts)
        for (const Primitive& p : part.mesh.primitives)
            if (p.material < scene.materials.size())
                if (const Material& m = scene.materials[p.material]; m.document >= 0 && m.index >= 0)
                    used[static_cast<std::size_t>(m.document)] = 1;
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        if (used[d]) continue;
        const auto own = static_cast<int>(d);
        io::TidyRequest request;
        for (const Part& part : scene.parts)
            if (part.document == own && part.source_mesh >= 0)
                request.meshes.insert(static_cast<std::size_t>(part.source_mesh));
        request.all = request.meshes.empty(); // it only holds materials, or its meshes were merged
        const Document bare = without_materials(*scene.documents[d]);
        io::DocumentOptimizer optimizer(bare);
        if (!optimizer.numbers_are_known()) continue;
        io::renumber(scene, own, optimizer.erase_unused(request));
        scene.documents[d] = optimizer.finish(std::make_shared<const Document>(bare));
    }
}

} // namespace facetmill::bake_stage
