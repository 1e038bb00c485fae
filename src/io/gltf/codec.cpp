// Reads a glTF file as a Scene (its document, its materials, and one part per node with a mesh), and
// writes it.

#include "base/fast_json.hpp"
#include "base/hash.hpp"
#include "base/progress.hpp"
#include "base/text/words.hpp"
#include "facetmill_version.hpp"
#include "io/attributes.hpp"
#include "io/flatten.hpp"
#include "io/gltf/contents/largest_pose.hpp"
#include "io/gltf/document/check.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/document/roots.hpp"
#include "io/gltf/document/shorten.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/instances.hpp"
#include "io/gltf/read/kinds.hpp"
#include "io/gltf/read/mesh.hpp"
#include "io/gltf/read/second_reader.hpp"
#include "io/gltf/write/join_documents.hpp"
#include "io/gltf/write/patch.hpp"
#include "io/images/image_files.hpp"
#include "io/trailing.hpp"
#include "io/write_options.hpp"
#include "parallel/memory.hpp"

#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::io::gltf {

namespace {

constexpr const char* centre_extension = "CESIUM_RTC";

/// True if a geometry reader understands the extension or may ignore it: materials, textures and lights do
/// not move faces.
bool understood(const std::string& extension) {
    static const std::set<std::string> known = {
        "KHR_draco_mesh_compression", "KHR_mesh_quantization",  "EXT_meshopt_compression",
        "KHR_meshopt_compression",    "EXT_mesh_manifold",      "EXT_mesh_gpu_instancing",
        "KHR_lights_punctual",        "EXT_lights_image_based", "KHR_xmp_json_ld",
        "KHR_animation_pointer",      "KHR_node_visibility",    "MSFT_lod",
        "MSFT_texture_dds",           "KHR_audio_emitter",      "EXT_mesh_features",
        "EXT_structural_metadata",    "KHR_techniques_webgl",   "KHR_physics_rigid_bodies",
        "KHR_implicit_shapes",        "KHR_node_hoverability",  "KHR_node_selectability"};
    const auto starts = [&](const char* prefix) { return extension.rfind(prefix, 0) == 0; };
    if (extension == centre_extension) return true;
    return known.count(extension) > 0 || starts("KHR_materials_") || starts("KHR_texture_") ||
           starts("EXT_texture_") || starts("EXT_materials_") || starts("ADOBE_materials_");
}

/// glTF 1.0 lists its contents by name instead of in arrays, and may lack "asset".
bool is_gltf_1(const Json& document) {
    if (document.contains("asset")) return false;
    for (const char* list : {"accessors", "bufferViews", "meshes", "nodes"})
        if (document.contains(list)) return document[list].is_object();
    return false;
}

void check_asset(const Json& document) {
    if (document.is_object() && is_gltf_1(document))
        throw Error(ErrorKind::malformed, "E-VERSION", "expected glTF 2.x, found glTF 1.0",
                    hint_for_version_1);
    const JsonCursor asset = JsonCursor(document, "").at("asset");
    const std::string version = asset.at("version").text(), least = asset.text_or("minVersion", "2.0");
    if (version.rfind("2.", 0) != 0)
        asset.at("version").fail(fmt::format("expected glTF 2.x, found \"{}\"", version), "E-VERSION",
                                 version.starts_with('1') ? hint_for_version_1 : "");
    if (least != "2.0")
        asset.at("minVersion").fail(fmt::format("glTF {} is needed to read it", least), "E-VERSION");
    const auto required = list(document, "extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i)
        if (!understood(required->at(i).text()))
            required->at(i).fail(
                fmt::format("the extension \"{}\" is required but not supported", required->at(i).text()),
                "E-EXTENSION");
}

Material read_material(const JsonCursor& place, std::size_t index) {
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

/// Restores the vertices of the file: one vertex for each glTF vertex, even at equal positions.
void unmerge(Mesh& mesh) {
    std::vector<Vec3> positions;
    for (const Index v : mesh.wedge_vertex) positions.push_back(mesh.positions[v]);
    if (mesh.has_seams()) mesh.positions = std::move(positions);
    mesh.wedge_vertex.clear();
}

double bytes_of(const Mesh& mesh) {
    double bytes = static_cast<double>(mesh.vertex_count() * sizeof(Vec3) +
                                       (mesh.corner_count() + mesh.wedge_vertex.size() + mesh.lines.size()) *
                                           sizeof(Index));
    for (const Attribute& a : mesh.attributes)
        std::visit([&](const auto& v) { bytes += static_cast<double>(v.size() * sizeof(v[0])); }, a.data);
    return bytes;
}

/// Warns that only the mesh of a node with many instances becomes a part.
void warn_of_instancing(const Placement& placement, ReadLog& log) {
    if (placement.instances == 0) return;
    log.warnings.push_back(
        {Severity::warning,
         "W-INSTANCING",
         fmt::format("part '{}' has {} instances by EXT_mesh_gpu_instancing: stages and formats other than "
                     "glTF see the mesh once, where the largest of them is",
                     placement.name, placement.instances),
         {},
         "load: {instances: expand} makes a part of each",
         false});
}

/// Warns that nodes with meshes without positions do not become parts, if other nodes do.
void warn_of_nodes_without_positions(const Source& source, const std::vector<NodeFrame>& frames,
                                     ReadLog& log) {
    std::size_t count = 0, first = 0;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        if (frames[n].mesh < 0) continue;
        const JsonCursor mesh = item(source.json(), "meshes", static_cast<std::size_t>(frames[n].mesh));
        if (kind_of_mesh(mesh) != Drawn::none) continue;
        if (count++ == 0) first = n;
    }
    if (count == 0) return;
    const std::string more = count > 1 ? fmt::format(" and {} more have", count - 1) : " has";
    log.warnings.push_back({Severity::warning,
                            "W-SKIPPED",
                            fmt::format("nodes[{}]{} a mesh without positions. The document keeps it "
                                        "unchanged, but stages do not move it, and other "
                                        "formats do not contain it",
                                        first, more),
                            {},
                            "",
                            false});
}

void warn_of_breaches(const Breaches& breaches, ReadLog& log) {
    if (breaches.count() == 0) return;
    const std::size_t more = breaches.count() - breaches.first().size();
    log.warnings.push_back(
        {Severity::warning,
         "W-GLTF",
         fmt::format("the document breaks {} of glTF 2.0: {}{}",
                     breaches.count() == 1 ? "a rule" : counted(breaches.count(), "rule"),
                     fmt::join(breaches.first(), "; "), more > 0 ? fmt::format("; and {} more", more) : ""),
         {},
         "export it again; the Khronos validator lists all",
         false});
}

/// Warns about parts outside the scene that viewers show; they are loaded nevertheless.
void warn_of_parts_not_shown(const Scene& scene, const Json& document, ReadLog& log) {
    const std::vector<bool> shown = shown_nodes(document);
    std::vector<std::string> names;
    for (const Part& part : scene.parts)
        if (part.node >= 0 && !shown[static_cast<std::size_t>(part.node)])
            names.push_back(one_line(part.name));
    if (names.empty()) return;
    log.warnings.push_back(
        {Severity::warning,
         "W-SCENES",
         fmt::format("{} not in the scene that viewers show, but in another or in none: {}",
                     names.size() == 1 ? "a part is" : counted(names.size(), "part") + " are",
                     some_of(names)),
         {},
         "they are measured, changed and written like the others; exclude them with the common key `only`",
         false});
}

void read_parts(Scene& scene, Source& source, const std::vector<NodeFrame>& frames,
                const ReadSettings& settings, ReadLog& log) {
    std::map<int, std::size_t> first_part; // by mesh: instances copy it
    std::size_t vertices = 0;
    double bytes = 0; // the total size of copies, because a node needs few bytes of JSON
    auto all = placements(source.json(), frames);
    stand_at_largest_instances(source, frames, all);
    ProgressSteps steps(std::vector<double>(all.size(), 1));
    for (const auto& placement : all) {
        warn_of_instancing(placement, log);
        Part part;
        if (const auto known = first_part.find(placement.mesh); known != first_part.end()) {
            bytes += bytes_of(scene.parts[known->second].mesh);
            if (is_much_memory(bytes))
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
        steps.next();
    }
    if (!all.empty()) warn_of_nodes_without_positions(source, frames, log);
    warn_of_parts_not_shown(scene, source.json(), log);
}

/// Warns about a document with primitives if none of them was read.
void warn_without_parts(const Json& document, ReadLog& log) {
    std::size_t primitives = 0;
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m)
        primitives += item(document, "meshes", m).at("primitives").size();
    if (primitives == 0) return;
    log.warnings.push_back(
        {Severity::warning,
         "W-SKIPPED",
         fmt::format("{} without a node or without positions. The document stays unchanged, and stages "
                     "ignore {}",
                     primitives == 1 ? "its only primitive is" : counted(primitives, "primitive") + " are",
                     primitives == 1 ? "it" : "them"),
         {},
         "export it again, with the nodes that show them",
         false});
}

Chunks chunks_of(const Input& input) {
    if (is_glb(input.bytes())) return split_glb(input.bytes());
    Chunks chunks;
    chunks.json = as_text(input.bytes());
    return chunks;
}

/// Replaces CESIUM_RTC by nodes: its centre is a translation of the whole file, with z up.
bool place_at_centre(Json& document) {
    if (!document.contains("extensions") || !document["extensions"].contains(centre_extension)) return false;
    const JsonCursor centre = JsonCursor(document, "").at("extensions").at(centre_extension).at("center");
    if (centre.size() != 3) centre.fail(fmt::format("expected 3 numbers, found {}", centre.size()));
    Transform t;
    constexpr std::size_t x = 0, y = 1, z = 2;
    t.m[0][3] = centre.at(x).real();
    t.m[1][3] = centre.at(z).real();
    t.m[2][3] = -centre.at(y).real();
    put_above_roots(document, t);
    document["extensions"].erase(centre_extension);
    if (document["extensions"].empty()) document.erase("extensions");
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (!document.contains(list)) continue;
        std::erase_if(document[list].get_ref<Json::array_t&>(),
                      [&](const Json& used) { return used == centre_extension; });
        if (document[list].empty()) document.erase(list);
    }
    return true;
}

Scene read_document(const Input& input, const ReadSettings& settings, ReadLog& log) {
    const Chunks chunks = chunks_of(input);
    warn_of_trailing(log, input.name(), chunks.skipped, "the JSON and the buffer");
    auto document = std::make_shared<Document>();
    document->name = input.name();
    document->json = std::string(chunks.json);
    Json json = parse_document(document->json);
    const ScopedDestroy after(json);
    check_asset(json);
    bool changed = make_integers(json);
    Breaches breaches;
    check_members(json, breaches);
    document->buffers = load_buffers(json, chunks.binary, input, log);
    document->files = load_images(json, input, log);
    check_rules(json, breaches);
    Source source(json, document->buffers);
    source.decoded = settings.decoded;
    changed |= correct_bounds(json, source, breaches);
    warn_of_breaches(breaches, log);
    if (settings.expand_instances && uses_extension(json, instancing_extension)) {
        expand_instances(json, document->buffers, log);
        changed = true;
    }
    changed |= part_kinds(json);
    changed |= place_at_centre(json);

    Scene scene;
    scene.unit = settings.unit.value_or(Unit::m);
    scene.up = settings.up.value_or(UpAxis::y);
    for (std::size_t i = 0; i < count_of(json, "materials"); ++i)
        scene.materials.push_back(read_material(item(json, "materials", i), i));
    const auto frames = node_frames(json, [&](const char* id, std::string message) {
        log.warnings.push_back({Severity::warning, id, std::move(message), {}, "", false});
    });
    changed |= drop_further_parents(json, frames);
    if (changed) document->json = to_string(json);
    read_parts(scene, source, frames, settings, log);
    if (scene.parts.empty()) warn_without_parts(json, log);
    scene.documents.push_back(std::move(document));
    return scene;
}

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    const std::size_t before = log.warnings.size();
    return in_file(input, [&] {
        Scene scene = read_document(input, settings, log);
        for (std::size_t i = before; i < log.warnings.size(); ++i)
            if (!log.warnings[i].where.known()) log.warnings[i].where = file_mark(input.name());
        return scene;
    });
}

namespace {

std::vector<NamedImage>
with_digests(const std::vector<std::pair<std::filesystem::path, std::filesystem::path>>& images) {
    std::vector<NamedImage> all;
    for (const auto& [name, path] : images) {
        try {
            all.push_back({name, sha256(Input::open(path).stored())});
        } catch (const Error&) { // the writer will not copy this image either
        }
    }
    return all;
}

} // namespace

void peek(const Input& input, FileHeader& header) {
    in_file(input, [&] {
        // The largest lists of a document's JSON. This check does not need them.
        constexpr std::array<std::string_view, 2> unread{"accessors", "bufferViews"};
        Json json = parse_document(chunks_of(input).json, unread);
        const ScopedDestroy after(json);
        check_asset(json);
        part_kinds(json);
        const std::vector<Placement> placed = placements(json, node_frames(json));
        for (const auto& placement : placed) header.parts.push_back(placement.name);
        if (!drawn_materials(json, placed).empty()) header.has_materials = [] { return true; };
        std::vector<std::pair<std::filesystem::path, std::filesystem::path>> images_there;
        for (const bool images : {false, true})
            for (const auto& name : neighbours(json, images ? "images" : "buffers")) {
                const auto path = path_below(input, name);
                if (!path) continue;
                header.files.push_back(*path);
                std::error_code ignored;
                if (images && std::filesystem::is_regular_file(*path, ignored))
                    images_there.emplace_back(name, *path);
            }
        if (!images_there.empty()) header.images = [images_there] { return with_digests(images_there); };
    });
}

// --- write

namespace {

Json empty_document() {
    return {{"asset", {{"version", "2.0"}, {"generator", "facetmill " FACETMILL_VERSION}}},
            {"scene", 0},
            {"scenes", Json::array({Json::object()})}};
}

/// Removes extensions of meshes and primitives from the list of used extensions if none of them has any left.
void drop_unused_extensions(Builder& builder) {
    bool draco = false, manifold = false;
    const auto has = [](const Json& object, const char* name) {
        return object.contains("extensions") && object["extensions"].contains(name);
    };
    for (std::size_t m = 0; m < count_of(builder.json(), "meshes"); ++m) {
        const Json& mesh = builder.json()["meshes"][m];
        manifold = manifold || has(mesh, "EXT_mesh_manifold");
        for (const auto& primitive : mesh["primitives"])
            draco = draco || has(primitive, "KHR_draco_mesh_compression");
    }
    if (!draco) builder.drop_extension("KHR_draco_mesh_compression");
    if (!manifold) builder.drop_extension("EXT_mesh_manifold");
}

void add_main_files(Patch& patch, const std::string& stem, Bytes buffer, bool binary) {
    Json& json = patch.builder.json();
    if (binary) {
        patch.written.files.push_back({stem + ".glb", join_glb(to_string(json), buffer)});
        return;
    }
    const std::string name = stem + ".bin";
    if (!buffer.empty()) {
        Json first = {{"uri", uri_of(name)}};
        first.update(json["buffers"][0]);
        json["buffers"][0] = std::move(first);
    }
    patch.written.files.push_back(
        {stem + ".gltf", bytes_of_text(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n")});
    if (!buffer.empty()) patch.written.files.push_back({name, std::move(buffer)});
}

/// Gives the asset the copyright and the extras of another document that it lacks.
void keep_asset(Json& asset, const Json& other) {
    const auto from = other.find("asset");
    if (from == other.end() || !from->is_object()) return;
    if (from->contains("copyright") && !asset.contains("copyright"))
        asset["copyright"] = (*from)["copyright"];
    const Json extras = from->value("extras", Json::object());
    if (!asset.contains("extras") && !extras.empty()) asset["extras"] = extras;
    if (asset.contains("extras") && asset["extras"].is_object() && extras.is_object())
        for (const auto& [name, value] : extras.items()) // extras of the first document take precedence
            if (!asset["extras"].contains(name)) asset["extras"][name] = value;
}

/// Whether the copyright or extras of another document's asset differ from the written ones.
bool has_other_metadata(const Json& asset, const Json& other) {
    const Json from = other.value("asset", Json::object());
    if (!from.is_object()) return false;
    if (from.contains("copyright") && from["copyright"] != asset.value("copyright", Json())) return true;
    const Json theirs = from.value("extras", Json()), own = asset.value("extras", Json());
    if (theirs.empty() || theirs == own) return false;
    if (!theirs.is_object()) return true;
    const auto items = theirs.items();
    return std::any_of(items.begin(), items.end(), [&](const auto& item) {
        return !own.contains(item.key()) || own[item.key()] != item.value();
    });
}

/// Warns that only the meshes and materials of another document are written, unless it was joined.
void warn_of_losses(Patch& patch, const std::string& name, const Json& other, bool joined) {
    std::vector<std::string> lost;
    for (const char* list : {"animations", "skins", "cameras", "extensions"})
        if (!joined && other.contains(list) && !other[list].empty()) lost.push_back(list);
    const Json extras = other.value("extras", Json());
    const bool loses_extras = !extras.empty() && extras != patch.builder.json().value("extras", Json());
    if (loses_extras || has_other_metadata(patch.builder.json()["asset"], other))
        lost.emplace_back("metadata");
    if (!lost.empty())
        patch.warn("W-MERGED",
                   fmt::format("{} of '{}' are written, but not its {}",
                               joined ? "the contents" : "only the meshes and materials", name,
                               fmt::join(lost, ", ")),
                   fmt::format("load '{}' alone, and write it to a separate file to keep them", name));
}

void merge_other_documents(Patch& patch, const std::set<int>& joined) {
    for (std::size_t d = 0; d < patch.scene.documents.size(); ++d) {
        if (static_cast<int>(d) == patch.base) continue;
        const Json other = parse_document(patch.scene.documents[d]->json);
        keep_asset(patch.builder.json()["asset"], other);
        warn_of_losses(patch, patch.scene.documents[d]->name, other, joined.contains(static_cast<int>(d)));
    }
}

/// The lists of a document that describe its data. Rewriting the data makes new items.
constexpr std::array<const char*, 3> data_lists{"accessors", "bufferViews", "buffers"},
    data_nouns{"accessor", "buffer view", "buffer"};

/// [data_lists] the number of items with extras.
std::array<std::size_t, 3> count_data_extras(const Json& document) {
    std::array<std::size_t, 3> counts{};
    for (std::size_t l = 0; l < counts.size(); ++l)
        for (std::size_t i = 0; i < count_of(document, data_lists[l]); ++i) {
            const Json& item = document[data_lists[l]][i];
            counts[l] += item.is_object() && !item.value("extras", Json()).empty() ? 1 : 0;
        }
    return counts;
}

void warn_of_data_extras(Patch& patch, const std::array<std::size_t, 3>& before) {
    const auto after = count_data_extras(patch.builder.json());
    std::vector<std::string> lost;
    for (std::size_t l = 0; l < before.size(); ++l)
        if (before[l] > after[l]) lost.push_back(counted(before[l] - after[l], data_nouns[l]));
    if (!lost.empty())
        patch.warn("W-LOST",
                   fmt::format("the extras of data that is rewritten are lost: {}", join_texts(lost)),
                   "move them to the mesh or the primitive, whose extras are kept");
}

/// A copy of the scene with colours of faces moved to wedges, and with NaN replaced in its attributes,
/// because glTF forbids NaN; empty without either.
std::optional<Scene> fitted_scene(const Scene& given, Written& written) {
    const auto has = [](const Part& part) {
        return has_nan(part.mesh) || has_colours_of_faces_only(part.mesh);
    };
    if (std::none_of(given.parts.begin(), given.parts.end(), has)) return {};
    Scene scene = given;
    for (Part& part : scene.parts) move_colours_to_wedges(part.mesh);
    NanCounts all;
    for (Part& part : scene.parts) {
        for (const auto& [name, count] : nan_of_primitives(part.mesh)) all[name] += count;
        zero_nan(part.mesh);
    }
    warn_of_nan(all, "glTF", written.warnings);
    return scene;
}

} // namespace

Written write(const Scene& given, const WriteSettings& settings, bool binary) {
    Written written;
    const auto fitted = fitted_scene(given, written);
    const Scene& fitting = fitted ? *fitted : given;
    BaseDocument found = base_document(fitting);
    const auto joined = join_documents(fitting, found);
    const Scene& scene = joined ? joined->scene : fitting;
    if (joined) found.json = joined->json;
    const int base = found.index;
    const Document* document = base < 0 ? nullptr : scene.documents[static_cast<std::size_t>(base)].get();
    const auto data_extras =
        document ? count_data_extras(found.json) : std::array<std::size_t, data_lists.size()>{};
    Builder builder(document ? std::move(found.json) : empty_document(),
                    document ? &document->buffers : nullptr);
    std::map<std::size_t, Transform> skin_moves;
    const bool skins_moved = std::any_of(scene.parts.begin(), scene.parts.end(), [](const Part& part) {
        return part.skinned && !part.transform.identity();
    });
    const Scene moved = skins_moved ? in_bind_pose(scene, base, skin_moves, written.warnings) : Scene{};
    Patch patch{skins_moved ? moved : scene, settings, builder, written, base};
    if (settings.draco.on && settings.mesh_manifold)
        patch.warn("W-MANIFOLD",
                   "EXT_mesh_manifold is not written with Draco, because Draco renumbers the vertices");
    Claims claims = claim_placements(patch, skin_moves);
    ProgressSteps steps({4, 1, 2, 3});
    PartMeshes meshes = patch_meshes(patch, std::move(claims));
    steps.next();
    PartNodes nodes = patch_nodes(patch, std::move(meshes));
    steps.next();
    const StoredMeshes stored = store_meshes(patch, std::move(nodes));
    store_streams(patch, stored);
    store_sparse_targets(patch, stored);
    interleave_attributes(patch, stored);
    steps.next();
    builder.compress(settings.meshopt);
    drop_unused_extensions(builder);
    merge_other_documents(patch, joined ? joined->joined : std::set<int>());
    warn_of_dropped(written, scene, "glTF");
    const std::string stem = settings.title.empty() ? "scene" : settings.title;
    const Textures textures = settings.textures != Textures::automatic ? settings.textures
                              : binary                                 ? Textures::embed
                                                                       : Textures::copy;
    ImageOwners owners = stored.images;
    if (joined) owners.insert(joined->images.begin(), joined->images.end());
    auto images = place_images(patch, owners, stem, textures);
    const bool shortens = settings.draco.on || settings.quantize.on || settings.meshopt.on;
    const auto worlds =
        shortens ? largest_worlds(builder.current(), node_frames(builder.json())) : std::vector<Transform>();
    Bytes buffer = builder.finish(written.warnings);
    drop_nulls(builder.json());
    warn_of_data_extras(patch, data_extras);
    // Without meshes, animations and programs find nodes by their names.
    if (settings.drop_names && !scene.parts.empty()) drop_names(builder.json());
    // Whole-number positions must match other files exactly, so an empty box keeps node transforms exact.
    if (shortens)
        shorten(builder.json(),
                settings.whole_positions ? Box{}
                : settings.drawn         ? *settings.drawn
                                         : drawn_bounds(scene, part_views(scene)),
                worlds);
    add_main_files(patch, stem, std::move(buffer), binary);
    for (auto& image : images) written.files.push_back(std::move(image));
    written.decoded = std::make_shared<const DracoDecodings>(std::move(builder.decoded));
    return written;
}

// --- gltf

namespace {

int sniff_glb(Span bytes) { return is_glb(bytes) ? 2 : 0; }

/// Certain for a JSON object with "asset" near its beginning or end. Any other JSON object may be glTF.
int sniff_gltf(Span bytes) {
    const std::string_view text = without_byte_order_mark(as_text(bytes));
    if (is_tileset(text)) return 0;
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') return 0;
    constexpr std::size_t near = 65536;
    const std::string_view tail = text.substr(text.size() > near ? text.size() - near : 0);
    const bool asset = text.substr(0, near).find("\"asset\"") != std::string_view::npos ||
                       tail.find("\"asset\"") != std::string_view::npos;
    return asset ? 2 : 1;
}

/// companion: the buffer file of a text document, whose images are also separate files.
Capabilities abilities(std::string companion) {
    const bool copies = !companion.empty();
    std::vector<WriteOption> options = gltf_mesh_options();
    options.insert(options.end(), {{"mesh_manifold", &WriteSettings::mesh_manifold},
                                   {"lods", [](const WriteSettings& s) { return s.lods.on; }},
                                   {"drop_names", &WriteSettings::drop_names}});
    return {.transforms = true,
            .skins = true,
            .points = true,
            .points_and_faces = true,
            .lines = true,
            .documents = true,
            .options = std::move(options),
            .attributes = "all at vertices, with materials and textures",
            .companion = std::move(companion),
            .copies_images = copies};
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
    .read_again = read_again,
});

const RegisterCodec gltf({
    .name = "gltf",
    .about = "glTF 2.0 as JSON, with a .bin and images as separate files",
    .extensions = {"gltf"},
    .unit = Unit::m,
    .up = UpAxis::y,
    .can = abilities(".bin"),
    .sniff = sniff_gltf,
    .read = read,
    .write = [](const Scene& scene, const WriteSettings& s) { return write(scene, s, false); },
    .peek = peek,
    .read_again = read_again,
});

} // namespace

} // namespace facetmill::io::gltf
