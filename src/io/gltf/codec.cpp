// A glTF file as a Scene and back: its document, its materials, and one part per node with triangles.

#include "base/memory.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/mesh.hpp"
#include "io/gltf/nodes.hpp"
#include "io/gltf/patch.hpp"

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

double bytes_of(const Mesh& mesh) {
    double bytes = static_cast<double>(mesh.vertex_count() * sizeof(Vec3) +
                                       (mesh.corner_count() + mesh.wedge_vertex.size()) * sizeof(Index));
    for (const Attribute& a : mesh.attributes)
        std::visit([&](const auto& v) { bytes += static_cast<double>(v.size() * sizeof(v[0])); }, a.data);
    return bytes;
}

void read_parts(Scene& scene, Source& source, const ReadSettings& settings, ReadLog& log) {
    const auto frames = node_frames(source.json(), [&](const char* id, std::string message) {
        log.warnings.push_back({Severity::warning, id, std::move(message), {}, "", false});
    });
    std::map<int, std::size_t> first_part; // of each mesh: instances copy it
    std::size_t vertices = 0;
    double bytes = 0; // of copies: a node costs few bytes of JSON
    for (const auto& placement : placements(source.json(), frames)) {
        Part part;
        if (const auto known = first_part.find(placement.mesh); known != first_part.end()) {
            bytes += bytes_of(scene.parts[known->second].mesh);
            require_memory(bytes, "copying the meshes of nodes", "use a machine with more memory");
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

void peek(const Input& input, FileHeader& header) {
    located(input, [&] {
        const Json json = parse_document(chunks_of(input).json);
        check_asset(json);
        for (const auto& placement : placements(json, node_frames(json)))
            header.parts.push_back(placement.name);
        header.has_materials = json.contains("materials") && !json["materials"].empty();
        for (const bool images : {false, true})
            for (const auto& name : neighbours(json, images ? "images" : "buffers")) {
                const auto path = neighbour_path(input, name);
                if (!path) continue;
                header.files.push_back(*path);
                std::error_code ignored;
                if (images && std::filesystem::is_regular_file(*path, ignored)) header.images.push_back(name);
            }
    });
}

// --- write

namespace {

Json empty_document() {
    return {{"asset", {{"version", "2.0"}, {"generator", "facetmill " FACETMILL_VERSION}}},
            {"scene", 0},
            {"scenes", Json::array({Json::object()})}};
}

std::string percent_encoded(const std::string& name) {
    static constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
    std::string out;
    for (const char c : name) {
        if (plain.find(c) != std::string_view::npos)
            out += c;
        else
            out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

Bytes to_bytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

void drop_unused_draco(Builder& builder) {
    bool used = false;
    for (std::size_t m = 0; m < count_of(builder.json(), "meshes"); ++m)
        for (const auto& primitive : builder.json()["meshes"][m]["primitives"])
            used = used || (primitive.contains("extensions") &&
                            primitive["extensions"].contains("KHR_draco_mesh_compression"));
    if (!used) builder.drop_extension("KHR_draco_mesh_compression");
}

/// The images that the written document names, as files beside it.
void add_images(Patch& patch) {
    for (std::size_t i = 0; i < count_of(patch.builder.json(), "images"); ++i) {
        const auto uri = item(patch.builder.json(), "images", i).find("uri");
        if (!uri || is_data_uri(uri->text())) continue;
        const auto found = patch.files.find(uri->text());
        const auto path = relative_path(uri->text());
        if (found == patch.files.end() || !path) {
            patch.warn("W-IMAGE", fmt::format("{}: the image \"{}\" was not read and is not copied",
                                              uri->path(), uri->text()));
            continue;
        }
        const bool there = std::any_of(patch.written.files.begin(), patch.written.files.end(),
                                       [&](const OutputFile& f) { return f.name == *path; });
        if (!there) patch.written.files.push_back({*path, found->second});
    }
}

void add_main_files(Patch& patch, Bytes buffer, bool binary) {
    const std::string stem = patch.settings.title.empty() ? "scene" : patch.settings.title;
    Json& json = patch.builder.json();
    if (binary) {
        patch.written.files.push_back({stem + ".glb", join_glb(to_string(json), buffer)});
        return;
    }
    std::string name = stem + ".bin";
    if (!buffer.empty()) {
        for (int n = 2; patch.files.count(name); ++n)
            name = fmt::format("{}.{}.bin", stem, n); // an image's name
        Json first = {{"uri", percent_encoded(name)}};
        first.update(json["buffers"][0]);
        json["buffers"][0] = std::move(first);
    }
    patch.written.files.push_back(
        {stem + ".gltf", to_bytes(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n")});
    if (!buffer.empty()) patch.written.files.push_back({name, std::move(buffer)});
}

/// What a second document has besides meshes and materials does not come along.
void warn_of_losses(Patch& patch) {
    for (std::size_t d = 1; d < patch.scene.documents.size(); ++d) {
        const Json other = parse_document(patch.scene.documents[d]->json);
        std::vector<std::string> lost;
        for (const char* list : {"animations", "skins", "cameras", "extensions"})
            if (other.contains(list) && !other[list].empty()) lost.push_back(list);
        if (!lost.empty())
            patch.warn("W-MERGED",
                       fmt::format("of '{}' only the meshes and materials are written, without its {}",
                                   patch.scene.documents[d]->name, fmt::join(lost, ", ")),
                       "write each file's parts by themselves to keep them");
    }
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings, bool binary) {
    Written written;
    const Document* document = scene.documents.empty() ? nullptr : scene.documents[0].get();
    Builder builder(document ? parse_document(document->json) : empty_document(),
                    document ? &document->buffers : nullptr);
    Patch patch{scene, settings, builder, written, document ? 0 : -1};
    if (document) patch.files = document->files;
    if (settings.draco.on && settings.mesh_manifold)
        patch.warn("W-MANIFOLD",
                   "EXT_mesh_manifold is not written under Draco, which renumbers what it names");
    claim_placements(patch);
    const auto mesh_of_part = patch_meshes(patch);
    patch_levels(patch, patch_nodes(patch, mesh_of_part));
    drop_dead_meshes(patch, mesh_of_part);
    drop_unused_draco(builder);
    warn_of_losses(patch);
    Bytes buffer = builder.finish(written.warnings);
    add_main_files(patch, std::move(buffer), binary);
    add_images(patch);
    return written;
}

// --- gltf

namespace {

int sniff_glb(Span bytes) { return is_glb(bytes) ? 2 : 0; }

/// An object that names its asset near its beginning or end is glTF; any other object may be.
int sniff_gltf(Span bytes) {
    const std::string_view text = as_text(bytes);
    const auto first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') return 0;
    constexpr std::size_t near = 65536;
    const std::string_view tail = text.substr(text.size() > near ? text.size() - near : 0);
    const bool asset = text.substr(0, near).find("\"asset\"") != std::string_view::npos ||
                       tail.find("\"asset\"") != std::string_view::npos;
    return asset ? 2 : 1;
}

Capabilities abilities(std::string companion) {
    return {.transforms = true,
            .skins = true,
            .mesh_manifold = true,
            .lods = true,
            .draco = Capabilities::Draco::on_request,
            .attributes = "all at vertices, with materials and textures",
            .companion = std::move(companion),
            .copies_images = true};
}

const RegisterCodec glb({
    .name = "glb",
    .about = "glTF 2.0 in one binary file, with Draco on request",
    .extensions = {"glb"},
    .unit = Unit::m,
    .up = UpAxis::y,
    .can = abilities(""),
    .sniff = sniff_glb,
    .read = read,
    .write = [](const Scene& scene, const WriteSettings& s) { return write(scene, s, true); },
    .peek = peek,
});

const RegisterCodec gltf({
    .name = "gltf",
    .about = "glTF 2.0 as JSON with a .bin and images beside it",
    .extensions = {"gltf"},
    .unit = Unit::m,
    .up = UpAxis::y,
    .can = abilities(".bin"),
    .sniff = sniff_gltf,
    .read = read,
    .write = [](const Scene& scene, const WriteSettings& s) { return write(scene, s, false); },
    .peek = peek,
});

} // namespace

} // namespace facetmill::io::gltf
