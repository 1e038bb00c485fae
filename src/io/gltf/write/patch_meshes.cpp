#include "io/gltf/encode/encode.hpp"
#include "io/gltf/read/mesh.hpp"
#include "io/gltf/write/patch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// Parts that share a source mesh and are still equal.
struct Variant {
    std::size_t example;   ///< an example part
    bool original = false; ///< true if unchanged, so that its primitives stay
    int mesh = -1;
    std::size_t dropped_faces = 0;
};

bool same_attribute(const Attribute& a, const Attribute& b) {
    return a.name == b.name && a.domain == b.domain && a.role == b.role && a.components == b.components &&
           a.normalised == b.normalised && a.data == b.data;
}

bool has_draco(const Json& primitive) {
    return primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression");
}

/// True if meshopt compresses the accessor's view.
bool has_meshopt(const Json& document, const Json& accessor) {
    const Json& a = document["accessors"][accessor.get<std::size_t>()];
    return a.contains("bufferView") &&
           compression_of(document["bufferViews"][a["bufferView"].get<std::size_t>()]);
}

/// True if meshopt can compress the triangles or points well: in a suitable order, with separate attributes.
bool ready_for_meshopt(const Json& document, const Json& primitive) {
    const bool in_order = kind_of(JsonCursor(primitive, "")) == Drawn::points ||
                          (primitive.contains("indices") && has_meshopt(document, primitive["indices"]));
    return in_order && has_meshopt(document, primitive["attributes"]["POSITION"]);
}

/// True if the mesh or one of its primitives has extensions.
bool is_extended(const Json& mesh) {
    const auto extended = [](const Json& object) { return object.contains("extensions"); };
    return extended(mesh) || std::any_of(mesh["primitives"].begin(), mesh["primitives"].end(), extended);
}

/// True if the primitives in the document already satisfy the settings.
bool stored_as_wanted(const Patch& patch, const Json& mesh) {
    const TriangleOrder order = patch.settings.order;
    const bool stays = order == TriangleOrder::automatic || order == TriangleOrder::keep;
    const bool points = kind_of_mesh(JsonCursor(mesh, "")) == Drawn::points && !is_extended(mesh);
    for (const auto& primitive : mesh["primitives"]) {
        const bool triangles = makes_triangles(JsonCursor(primitive, ""));
        if (triangles && !stays) return false;
        if (triangles && has_draco(primitive) != patch.settings.draco.on) return false;
        if ((triangles || points) && patch.settings.meshopt.on &&
            !ready_for_meshopt(patch.builder.json(), primitive))
            return false;
    }
    const bool manifold = mesh.contains("extensions") && mesh["extensions"].contains("EXT_mesh_manifold");
    return manifold || patch.settings.draco.on || !patch.settings.mesh_manifold;
}

/// True if a face or a line uses each wedge, or the mesh has neither.
bool uses_all_wedges(const Mesh& mesh) {
    const bool lines = mesh.face_count() == 0;
    const std::vector<Index>& ends = lines ? mesh.lines : mesh.corners;
    if (ends.empty()) return true;
    std::vector<std::uint8_t> used(mesh.wedge_count());
    for (const Index w : ends) used[w] = 1;
    return std::find(used.begin(), used.end(), 0) == used.end();
}

/// True if the mesh would be rounded or compressed with vertices that it does not use, as meshes of one large
/// accessor have. A mesh with extensions is not changed.
bool has_excess(const Patch& patch, const Json& json, const Mesh& mesh) {
    const WriteSettings& s = patch.settings;
    if (!s.draco.on && !s.quantize.on && !s.meshopt.on) return false;
    return !is_extended(json) && !uses_all_wedges(mesh);
}

bool is_original(Patch& patch, const Part& part) {
    const auto mesh = static_cast<std::size_t>(part.source_mesh);
    const Json& json = patch.builder.json()["meshes"][mesh];
    if (part.changed || !stored_as_wanted(patch, json) || has_excess(patch, json, part.mesh)) return false;
    const Mesh read = decode_mesh(patch.builder.source(), mesh).mesh;
    return same_mesh(read, part.mesh, [&](Index there, Index here) {
        if (here == none || here >= patch.scene.materials.size()) return there == here;
        const Material& m = patch.scene.materials[here];
        return m.document == patch.base && m.index == static_cast<int>(there);
    });
}

EncodeSettings settings_for(MaterialCopies& copies, const Part& part) {
    const Patch& patch = copies.patch;
    EncodeSettings s;
    s.draco = patch.settings.draco;
    const auto number = static_cast<std::size_t>(&part - &patch.scene.parts[0]);
    s.draco.position_bits = patch.settings.grid_bits(number);
    s.lattice = patch.settings.lattice(number);
    s.quantize = patch.settings.quantize;
    s.filters = patch.settings.meshopt.on && patch.settings.meshopt.filters;
    s.manifold = patch.settings.mesh_manifold;
    s.whole_positions = patch.settings.whole_positions;
    s.order = patch.settings.order;
    if (s.order == TriangleOrder::automatic)
        s.order = patch.settings.meshopt.on ? TriangleOrder::size : TriangleOrder::draw;
    s.keep_exact = patch.settings.quantize.on;
    s.name = part.name;
    s.material = [&copies](Index m) { return patch_material(copies, m); };
    s.variants = [&copies, document = part.document](const Primitive& primitive, const Json& extension) {
        return patch_variants(copies, primitive, document, extension);
    };
    // Feature numbers and tables are only valid in one document.
    for (std::size_t d = 0; d < patch.scene.documents.size(); ++d)
        if (static_cast<int>(d) != patch.base)
            for (const char* name : {"EXT_mesh_features", "EXT_structural_metadata"})
                s.keep_features &= patch.scene.documents[d]->json.find(name) == std::string::npos;
    s.columns.skinned = part.document < 0 || part.document == patch.base;
    s.columns.quantised = uses_extension(patch.builder.json(), "KHR_mesh_quantization");
    return s;
}

/// Releases the accessors of EXT_mesh_manifold for a mesh that has changed.
void release_manifold(Patch& patch, const Json& extension) {
    patch.builder.release_mesh(
        {{"primitives", Json::array()}, {"extensions", {{"EXT_mesh_manifold", extension}}}});
    const AttributeChange change{
        "EXT_mesh_manifold", Domain::face, AttributeChange::Kind::dropped,
        "it refers to the corners of a mesh that is written again; mesh_manifold: true writes it again"};
    auto& all = patch.written.changes;
    if (!patch.settings.mesh_manifold && std::find(all.begin(), all.end(), change) == all.end())
        all.push_back(change);
}

/// Drops extensions of the mesh that describe its old geometry.
void drop_extensions(Patch& patch, Json& mesh, const Part& part) {
    if (!mesh.contains("extensions")) return;
    for (const auto& [name, value] : mesh["extensions"].items()) {
        if (name == "EXT_mesh_manifold") { // it is written again on request
            release_manifold(patch, value);
            continue;
        }
        patch.written.changes.push_back(
            {name, Domain::face, AttributeChange::Kind::dropped, "an extension of a mesh that has changed"});
        patch.warn(
            "W-EXTENSION",
            fmt::format("part '{}': the extension {} of its mesh is dropped, because the mesh has changed",
                        part.name, name));
    }
    mesh.erase("extensions");
}

/// The mesh object of a part. `mesh`: the old object (or only a name). Null if no primitive is left.
Json encoded_object(MaterialCopies& copies, Json mesh, Variant& variant) {
    Patch& patch = copies.patch;
    const Part& part = patch.scene.parts[variant.example];
    EncodedMesh encoded = encode_mesh(patch.builder, part.mesh, settings_for(copies, part), patch.written);
    variant.dropped_faces = encoded.dropped_faces;
    patch.written.cache.add(encoded.cache);
    Json untouched = Json::array(); // without positions, and lines that became tubes
    if (mesh.contains("primitives")) {
        const Drawn main = kind_of_mesh(JsonCursor(mesh, ""));
        for (auto& primitive : mesh["primitives"])
            if (kind_of(JsonCursor(primitive, "")) != main) untouched.push_back(primitive);
    }
    for (auto& primitive : untouched) encoded.primitives.push_back(std::move(primitive));
    if (encoded.primitives.empty()) return nullptr;
    mesh["primitives"] = std::move(encoded.primitives);
    drop_extensions(patch, mesh, part);
    if (!encoded.extensions.is_null()) mesh["extensions"] = std::move(encoded.extensions);
    if (mesh.contains("weights") && mesh["weights"].size() != encoded.targets) mesh.erase("weights");
    return mesh;
}

/// True if the variant is a level of detail of an earlier variant: both belong to the same node.
bool is_level(const Scene& scene, const std::vector<Variant>& variants, const Variant& variant) {
    const int node = scene.parts[variant.example].node;
    return node >= 0 && std::any_of(variants.data(), &variant, [&](const Variant& earlier) {
               return scene.parts[earlier.example].node == node;
           });
}

/// Writes all parts of one mesh of the patched document.
void patch_variants(MaterialCopies& copies, std::size_t mesh, std::vector<Variant>& variants) {
    Patch& patch = copies.patch;
    const bool all_original =
        std::all_of(variants.begin(), variants.end(), [](const Variant& v) { return v.original; });
    if (all_original) {
        for (auto& variant : variants) variant.mesh = static_cast<int>(mesh);
        return;
    }
    Json& meshes = patch.builder.json()["meshes"];
    const Json before = meshes[mesh];
    bool slot_free =
        std::none_of(variants.begin(), variants.end(), [](const Variant& v) { return v.original; });
    const Drawn main = kind_of_mesh(JsonCursor(before, ""));
    if (slot_free)
        for (const auto& primitive : before["primitives"])
            if (kind_of(JsonCursor(primitive, "")) == main) patch.builder.release(primitive);
    int own = 0;
    for (auto& variant : variants) {
        if (variant.original) {
            variant.mesh = static_cast<int>(mesh);
            continue;
        }
        Json object = encoded_object(copies, before, variant);
        if (object.is_null()) continue;
        if (slot_free) {
            patch.builder.json()["meshes"][mesh] = std::move(object);
            variant.mesh = static_cast<int>(mesh);
            slot_free = false;
        } else {
            variant.mesh = static_cast<int>(patch.builder.add("meshes", std::move(object)));
            own += !is_level(patch.scene, variants, variant);
        }
    }
    if (own > 0)
        patch.warn("W-INSTANCES",
                   fmt::format("the instances of meshes[{}] differ now: {} of them {} a mesh of {} own", mesh,
                               own, own == 1 ? "has" : "have", own == 1 ? "its" : "their"));
}

} // namespace

bool same_mesh(const Mesh& a, const Mesh& b, const std::function<bool(Index, Index)>& same_material) {
    const auto same_primitive = [&](const Primitive& p, const Primitive& q) {
        return p.attributes == q.attributes && p.json == q.json && same_material(p.material, q.material);
    };
    return a.positions == b.positions && a.wedge_vertex == b.wedge_vertex && a.corners == b.corners &&
           a.face_offsets == b.face_offsets && a.lines == b.lines && a.line_primitive == b.line_primitive &&
           std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
                      same_attribute) &&
           std::equal(a.primitives.begin(), a.primitives.end(), b.primitives.begin(), b.primitives.end(),
                      same_primitive);
}

PartMeshes patch_meshes(Patch& patch, Claims claims) {
    MaterialCopies copies{patch};
    const auto& parts = patch.scene.parts;
    const std::size_t known_meshes = count_of(patch.builder.json(), "meshes");
    std::vector<std::size_t> variant_of(parts.size());
    std::map<std::pair<int, int>, std::vector<Variant>>
        families; // families by document and mesh; each new part is separate
    const auto key_of = [&](std::size_t i) {
        const Part& p = parts[i];
        const bool ours = p.document == patch.base && p.document >= 0 && p.source_mesh >= 0 &&
                          static_cast<std::size_t>(p.source_mesh) < known_meshes;
        if (ours || (p.document > 0 && p.source_mesh >= 0)) return std::pair(p.document, p.source_mesh);
        return std::pair(-1, static_cast<int>(i));
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto& family = families[key_of(i)];
        const auto same = std::find_if(family.begin(), family.end(), [&](const Variant& v) {
            return parts[v.example].changed == parts[i].changed &&
                   same_mesh(parts[v.example].mesh, parts[i].mesh, std::equal_to<>());
        });
        variant_of[i] = static_cast<std::size_t>(same - family.begin());
        if (same == family.end())
            family.push_back(
                {i, key_of(i).first == patch.base && patch.base >= 0 && is_original(patch, parts[i])});
    }
    for (auto& [key, family] : families) {
        if (key.first == patch.base && patch.base >= 0) {
            patch_variants(copies, static_cast<std::size_t>(key.second), family);
            continue;
        }
        for (auto& variant : family) {
            Json object = encoded_object(copies, {{"name", parts[variant.example].name}}, variant);
            if (!object.is_null())
                variant.mesh = static_cast<int>(patch.builder.add("meshes", std::move(object)));
        }
    }
    std::vector<int> mesh_of_part(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Variant& variant = families[key_of(i)][variant_of[i]];
        mesh_of_part[i] = variant.mesh;
        patch.written.dropped_faces += variant.dropped_faces;
    }
    return {std::move(claims), std::move(mesh_of_part), std::move(copies.images)};
}

void drop_dead_meshes(Patch& patch, const PartMeshes& meshes) {
    std::set<std::size_t> dead;
    for (const auto& placement : meshes.claims.placements)
        dead.insert(static_cast<std::size_t>(placement.mesh));
    for (const int mesh : meshes.of_part)
        if (mesh >= 0) dead.erase(static_cast<std::size_t>(mesh));
    Json& json = patch.builder.json();
    visit_mesh_references(json, [&](Json& r) { dead.erase(r.get<std::size_t>()); });
    if (dead.empty() || has_unknown_extensions(json)) return; // also pointers of animations
    for (const std::size_t mesh : dead)
        for (const auto& primitive : json["meshes"][mesh]["primitives"]) patch.builder.release(primitive);
    erase_items(json["meshes"], dead, [&](const auto& visit) { visit_mesh_references(json, visit); });
}

} // namespace facetmill::io::gltf
