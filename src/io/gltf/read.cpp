#include "io/gltf/read.hpp"

#include "io/gltf/container.hpp"
#include "io/gltf/files.hpp"
#include "io/gltf/mesh.hpp"
#include "io/gltf/nodes.hpp"

#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::io::gltf {

namespace {

/// What a reader of geometry must understand, or may safely not: materials, textures and lights do not move a
/// face.
bool understood(const std::string& extension) {
    static const std::set<std::string> known = {"KHR_draco_mesh_compression",
                                                "KHR_mesh_quantization",
                                                "EXT_meshopt_compression",
                                                "EXT_mesh_manifold",
                                                "EXT_mesh_gpu_instancing",
                                                "KHR_lights_punctual",
                                                "EXT_lights_image_based",
                                                "KHR_xmp_json_ld",
                                                "KHR_animation_pointer",
                                                "KHR_node_visibility",
                                                "MSFT_lod",
                                                "MSFT_texture_dds",
                                                "KHR_audio_emitter",
                                                "EXT_mesh_features",
                                                "EXT_structural_metadata",
                                                "KHR_techniques_webgl",
                                                "KHR_physics_rigid_bodies",
                                                "KHR_implicit_shapes",
                                                "KHR_node_hoverability",
                                                "KHR_node_selectability"};
    const auto starts = [&](const char* prefix) { return extension.rfind(prefix, 0) == 0; };
    return known.count(extension) > 0 || starts("KHR_materials_") || starts("KHR_texture_") ||
           starts("EXT_texture_") || starts("EXT_materials_") || starts("ADOBE_materials_");
}

void check_asset(const Json& document) {
    const Place asset = Place(document, "").at("asset");
    const std::string version = asset.at("version").text(), least = asset.text_or("minVersion", "2.0");
    if (version.rfind("2.", 0) != 0)
        asset.at("version").fail(fmt::format("expected glTF 2.x, found \"{}\"", version), "E-VERSION");
    if (least != "2.0")
        asset.at("minVersion").fail(fmt::format("glTF {} is needed to read it", least), "E-VERSION");
    const auto required = list(document, "extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i)
        if (!understood(required->at(i).text()))
            required->at(i).fail(
                fmt::format("the extension \"{}\" is required and not supported", required->at(i).text()),
                "E-EXTENSION");
}

Material read_material(const Place& place, std::size_t index) {
    Material material;
    material.name = place.text_or("name", "");
    material.double_sided = place.boolean_or("doubleSided", false);
    material.document = 0;
    material.index = static_cast<int>(index);
    const auto pbr = place.find("pbrMetallicRoughness");
    const auto colour = pbr ? pbr->find("baseColorFactor") : std::nullopt;
    if (colour && colour->size() != 4)
        colour->fail(fmt::format("expected 4 numbers, found {}", colour->size()));
    for (std::size_t i = 0; colour && i < 4; ++i) material.base_colour[i] = colour->at(i).real();
    return material;
}

/// The mesh as the file has it: a vertex for every one of glTF's, whatever their places.
void unmerge(Mesh& mesh) {
    std::vector<Vec3> positions;
    for (const Index v : mesh.wedge_vertex) positions.push_back(mesh.positions[v]);
    if (mesh.has_seams()) mesh.positions = std::move(positions);
    mesh.wedge_vertex.clear();
}

void read_parts(Scene& scene, Source& source, const ReadSettings& settings, ReadLog& log) {
    const auto frames = node_frames(source.json(), [&](const char* id, std::string message) {
        log.warnings.push_back({Severity::warning, id, std::move(message), {}, ""});
    });
    std::map<int, std::size_t> first_part; // of each mesh: instances copy it
    std::size_t vertices = 0;
    for (const auto& placement : placements(source.json(), frames)) {
        Part part;
        if (const auto known = first_part.find(placement.mesh); known != first_part.end()) {
            part.mesh = scene.parts[known->second].mesh;
        } else {
            DecodedMesh decoded =
                decode_mesh(source, static_cast<std::size_t>(placement.mesh), settings.max_vertices);
            part.mesh = std::move(decoded.mesh);
            if (settings.weld == Weld::off) unmerge(part.mesh);
            log.warnings.insert(log.warnings.end(), decoded.warnings.begin(), decoded.warnings.end());
            first_part[placement.mesh] = scene.parts.size();
        }
        vertices += part.mesh.wedge_count();
        if (vertices > settings.max_vertices)
            throw Error(ErrorKind::limit, "E-LIMIT",
                        fmt::format("its nodes place more than {} vertices", settings.max_vertices));
        part.name = placement.name;
        part.transform = placement.world;
        part.document = 0;
        part.node = placement.node;
        part.source_mesh = placement.mesh;
        part.skinned = placement.skinned;
        scene.parts.push_back(std::move(part));
    }
}

Chunks chunks_of(const Input& input) {
    if (is_glb(input.bytes())) return split_glb(input.bytes());
    Chunks chunks;
    chunks.json = as_text(input.bytes());
    return chunks;
}

Scene read_document(const Input& input, const ReadSettings& settings, ReadLog& log) {
    const Chunks chunks = chunks_of(input);
    auto document = std::make_shared<Document>();
    document->name = input.name();
    document->json = std::string(chunks.json);
    const Json json = parse_document(document->json);
    check_asset(json);
    document->buffers = load_buffers(json, chunks.binary, input, log);
    document->files = load_images(json, input, log);

    Scene scene;
    scene.unit = settings.unit.value_or(Unit::m);
    scene.up = settings.up.value_or(UpAxis::y);
    for (std::size_t i = 0; i < count_of(json, "materials"); ++i)
        scene.materials.push_back(read_material(item(json, "materials", i), i));
    Source source(json, document->buffers);
    read_parts(scene, source, settings, log);
    scene.documents.push_back(std::move(document));
    return scene;
}

/// What body gives; its errors are placed in the file.
template <class Body>
auto located(const Input& input, Body&& body) {
    try {
        return body();
    } catch (Error& e) {
        throw e.at(file_mark(input.name()));
    } catch (const Json::exception& e) {
        throw Error(ErrorKind::malformed, "E-GLTF", e.what(), "", file_mark(input.name()));
    }
}

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    const std::size_t before = log.warnings.size();
    return located(input, [&] {
        Scene scene = read_document(input, settings, log);
        for (std::size_t i = before; i < log.warnings.size(); ++i)
            if (!log.warnings[i].where.known()) log.warnings[i].where = file_mark(input.name());
        return scene;
    });
}

std::vector<std::string> peek(const Input& input) {
    return located(input, [&] {
        const Json json = parse_document(chunks_of(input).json);
        check_asset(json);
        std::vector<std::string> names;
        for (const auto& placement : placements(json, node_frames(json))) names.push_back(placement.name);
        return names;
    });
}

} // namespace facetmill::io::gltf
