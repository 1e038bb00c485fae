#include "base/math/portable_math.hpp"
#include "geometry/deviation/deviation.hpp"
#include "io/gltf/document/node_references.hpp"
#include "io/gltf/read/instances.hpp"
#include "io/gltf/write/patch.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// The number of morph targets of a document node's mesh; 0 if there are none.
std::size_t target_count(const Json& document, const Json& node) {
    if (!node.contains("mesh")) return 0;
    const Json& first = document["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    return first.contains("targets") ? first["targets"].size() : 0;
}

/// True if a channel animates morph weights of a node that no longer has targets. Warns about it.
bool is_dead(Patch& patch, const JsonCursor& channel) {
    const Json &document = patch.builder.json(), &source = patch.builder.source().json();
    const JsonCursor target = channel.at("target");
    if (target.text_or("path", "") != "weights" || !target.find("node")) return false;
    const auto n = target.at("node").index(count_of(source, "nodes"), "node");
    if (target_count(document, document["nodes"][n]) > 0 || target_count(source, source["nodes"][n]) == 0)
        return false;
    patch.warn("W-MORPH", fmt::format("nodes[{}] has no morph targets now: their animation is dropped", n));
    return true;
}

/// Drops animations of morph weights without targets, which glTF forbids, and animations that become empty.
void drop_dead_weights(Patch& patch) {
    Json& document = patch.builder.json();
    const std::size_t count = count_of(document, "animations");
    if (count == 0) return;
    Json kept = Json::array();
    for (std::size_t a = 0; a < count; ++a) {
        Json animation = document["animations"][a], channels = Json::array();
        const JsonCursor place = item(document, "animations", a).at("channels");
        for (std::size_t c = 0; c < place.size(); ++c)
            if (!is_dead(patch, place.at(c))) channels.push_back(animation["channels"][c]);
        animation["channels"] = std::move(channels);
        if (!animation["channels"].empty()) kept.push_back(std::move(animation));
    }
    document["animations"] = std::move(kept);
    if (document["animations"].empty()) document.erase("animations");
}

void remove_mesh(Json& node) {
    for (const char* key : {"mesh", "skin", "weights"}) node.erase(key);
}

void set_mesh(Patch& patch, std::size_t node, const Placement& placement, int part, int mesh) {
    Json& json = patch.builder.json()["nodes"][node];
    if (part < 0 || mesh < 0) return remove_mesh(json);
    json["mesh"] = mesh;
    if (placement.skinned && !patch.scene.parts[static_cast<std::size_t>(part)].skinned) json.erase("skin");
    const std::size_t targets = target_count(patch.builder.json(), json);
    if (json.contains("weights") && json["weights"].size() != targets) json.erase("weights");
    const std::string& name = patch.scene.parts[static_cast<std::size_t>(part)].name;
    if (name != placement.name) json["name"] = name;
}

/// The wanted world transform of a part's node: the part's transform without its instance transform.
Transform node_world(const Patch& patch, const Claims& claims, const Part& part) {
    const auto found = claims.largest_instances.find(part.node);
    if (part.document != patch.base || found == claims.largest_instances.end()) return part.transform;
    const Transform& before = claims.frames[static_cast<std::size_t>(part.node)].world;
    if (part.transform == before * found->second) return before;
    const auto back = inverse(found->second);
    return back ? part.transform * *back : part.transform;
}

/// The wanted world transforms of the document's nodes: the transform of the part, otherwise unchanged.
std::vector<Transform> wanted_worlds(const Patch& patch, const Claims& claims) {
    std::vector<Transform> worlds;
    for (const auto& frame : claims.frames) worlds.push_back(frame.world);
    for (std::size_t p = 0; p < claims.placements.size(); ++p) {
        const auto& placement = claims.placements[p];
        if (claims.claimed[p] < 0 || placement.node < 0) continue;
        const Part& part = patch.scene.parts[static_cast<std::size_t>(claims.claimed[p])];
        if (!part.skinned) worlds[static_cast<std::size_t>(placement.node)] = node_world(patch, claims, part);
    }
    return worlds;
}

/// Replaces a node's transform by a matrix.
void set_matrix(Json& node, const Transform& local) {
    for (const char* key : {"translation", "rotation", "scale", "matrix"}) node.erase(key);
    if (!local.identity()) node["matrix"] = matrix(local);
}

/// True if equal within the rounding of a product with an inverse.
bool nearly_same(const Transform& a, const Transform& b) {
    double most = 0, apart = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            most = std::max(most, std::abs(b.m[i][j]));
            apart = std::max(apart, std::abs(a.m[i][j] - b.m[i][j]));
        }
    return apart <= 1e-12 * most;
}

/// Replaces a node by another everywhere in the hierarchy: in scenes, as a child, as a level of detail.
void place_instead(Json& document, std::size_t node, std::size_t other) {
    const auto replace = [&](Json& list) {
        for (Json& index : list)
            if (index == node) index = other;
    };
    for (Json& scene : document["scenes"])
        if (scene.contains("nodes")) replace(scene["nodes"]);
    for (Json& parent : document["nodes"]) {
        if (parent.contains("children")) replace(parent["children"]);
        const Json::json_pointer levels("/extensions/MSFT_lod/ids");
        if (parent.contains(levels)) replace(parent[levels]);
    }
}

/// Warns about a node that moves while an animated ancestor stays.
void warn_of_animated_ancestor(Patch& patch, const Claims& claims, std::size_t n,
                               const std::set<std::size_t>& animated, const std::vector<Transform>& wanted) {
    for (int p = claims.frames[n].parent; p >= 0; p = claims.frames[static_cast<std::size_t>(p)].parent) {
        const auto parent = static_cast<std::size_t>(p);
        if (animated.contains(parent) && wanted[parent] == claims.frames[parent].world)
            return patch.warn("W-TRANSFORM",
                              fmt::format("nodes[{}] has moved under the animated nodes[{}], which stays: "
                                          "the animation plays around the old position",
                                          n, p));
    }
}

/// Keeps the transforms of nodes whose parent and local transform have not changed.
void move_nodes(Patch& patch, const Claims& claims) {
    const auto wanted = wanted_worlds(patch, claims);
    const auto animated = animated_nodes(patch.builder.json());
    for (const std::size_t n : parents_first(claims.frames)) {
        const auto& frame = claims.frames[n];
        const auto parent = static_cast<std::size_t>(frame.parent);
        const bool parent_moved = frame.parent >= 0 && wanted[parent] != claims.frames[parent].world;
        if (!parent_moved && wanted[n] == frame.world) continue;
        const auto root = claims.above.find(n);
        const auto up = frame.parent >= 0            ? inverse(wanted[parent])
                        : root == claims.above.end() ? Transform{}
                                                     : inverse(root->second);
        const auto down = animated.contains(n) ? inverse(frame.local) : Transform{};
        if (!up || !down) {
            patch.warn("W-TRANSFORM",
                       fmt::format("nodes[{}] {} and keeps its transform, although its part has moved", n,
                                   up ? "has an animation of a flattening transform"
                                      : "is under a node that flattens it"));
            continue;
        }
        if (parent_moved && nearly_same(*up * wanted[n], frame.local)) continue;
        if (!parent_moved) warn_of_animated_ancestor(patch, claims, n, animated, wanted);
        // An animated node keeps its own transform, which the animation drives: a new node above moves both.
        if (animated.contains(n))
            move_from_above(patch, n, *up * wanted[n] * *down);
        else
            set_matrix(patch.builder.json()["nodes"][n], *up * wanted[n]);
    }
}

/// The scene for new nodes: the default scene.
Json& root_nodes(Json& document) {
    if (count_of(document, "scenes") == 0) {
        document["scenes"] = Json::array({Json::object()});
        document["scene"] = 0;
    }
    const std::size_t index =
        document.contains("scene")
            ? JsonCursor(document, "").at("scene").index(document["scenes"].size(), "scene")
            : 0;
    Json& nodes = document["scenes"][index]["nodes"];
    if (!nodes.is_array()) nodes = Json::array();
    return nodes;
}

/// The document node from which a new part was split off; -1 for none.
int origin_of(const Patch& patch, const Claims& claims, const Part& part) {
    const bool there = part.document == patch.base && part.node >= 0 &&
                       static_cast<std::size_t>(part.node) < claims.frames.size();
    return there ? part.node : -1;
}

/// The part's transform relative to its origin, if an animation moves that node; none if the part is
/// independent.
std::optional<Transform> place_below(const Patch& patch, const Claims& claims, const Part& part, int origin) {
    const auto animated = animated_nodes(patch.builder.json());
    bool moves = false;
    for (int n = origin; n >= 0; n = claims.frames[static_cast<std::size_t>(n)].parent)
        moves |= animated.contains(static_cast<std::size_t>(n));
    if (!moves) return {};
    const auto up = inverse(wanted_worlds(patch, claims)[static_cast<std::size_t>(origin)]);
    if (!up) return {};
    const Transform local = *up * node_world(patch, claims, part);
    return nearly_same(local, {}) ? Transform{} : local;
}

/// Copies the morph weights and their animation from the origin of a split-off part.
void copy_weights(Patch& patch, int origin, std::size_t node) {
    Json& document = patch.builder.json();
    if (origin < 0 || target_count(document, document["nodes"][node]) == 0) return;
    const Json& from = document["nodes"][static_cast<std::size_t>(origin)];
    if (from.contains("weights")) document["nodes"][node]["weights"] = from["weights"];
    if (!document.contains("animations")) return;
    for (Json& animation : document["animations"]) {
        Json more = Json::array();
        for (const Json& channel : animation["channels"])
            if (channel["target"].value("path", "") == "weights" &&
                channel["target"].value("node", -1) == origin) {
                more.push_back(channel);
                more.back()["target"]["node"] = node;
            }
        for (Json& channel : more) animation["channels"].push_back(std::move(channel));
    }
}

std::size_t add_node(Patch& patch, const Claims& claims, const Part& part, int mesh) {
    Json node = {{"name", part.name}};
    if (mesh >= 0) node["mesh"] = mesh;
    Json& document = patch.builder.json();
    const int origin = origin_of(patch, claims, part);
    std::optional<Transform> below;
    if (part.skinned && mesh >= 0 && origin >= 0) {
        const Json& source = patch.builder.source().json()["nodes"][static_cast<std::size_t>(origin)];
        if (source.contains("skin")) node["skin"] = source["skin"];
    } else {
        below = place_below(patch, claims, part, origin);
        const Transform at = below ? *below : node_world(patch, claims, part);
        if (!at.identity()) node["matrix"] = matrix(at);
        if (mesh >= 0 && claims.largest_instances.contains(origin)) {
            const Json& extensions = document["nodes"][static_cast<std::size_t>(origin)]["extensions"];
            for (const char* name : {instancing_extension, instance_features})
                if (extensions.contains(name)) node["extensions"][name] = extensions[name];
        }
    }
    const std::size_t index = patch.builder.add("nodes", std::move(node));
    Json& siblings =
        below ? document["nodes"][static_cast<std::size_t>(origin)]["children"] : root_nodes(document);
    if (!siblings.is_array()) siblings = Json::array();
    siblings.push_back(index);
    copy_weights(patch, origin, index);
    return index;
}

} // namespace

void move_from_above(Patch& patch, std::size_t node, const Transform& by) {
    const std::size_t above = patch.builder.add("nodes", Json::object());
    Json& document = patch.builder.json();
    place_instead(document, node, above);
    document["nodes"][above]["children"] = Json::array({node});
    set_matrix(document["nodes"][above], by);
}

Claims claim_placements(Patch& patch, const std::map<std::size_t, Transform>& skin_moves) {
    Claims claims;
    if (patch.base < 0) return claims;
    claims.frames = node_frames(patch.builder.json());
    claims.placements = placements(patch.builder.json(), claims.frames);
    stand_at_largest_instances(patch.builder.source(), claims.frames, claims.placements);
    claims.claimed.assign(claims.placements.size(), -1);
    for (const Placement& placement : claims.placements)
        if (placement.instances > 0) claims.largest_instances[placement.node] = placement.largest_instance;
    std::map<std::pair<int, int>, std::size_t> placement_at; // placements by node and mesh
    for (std::size_t p = 0; p < claims.placements.size(); ++p)
        placement_at[{claims.placements[p].node, claims.placements[p].mesh}] = p;
    for (std::size_t i = 0; i < patch.scene.parts.size(); ++i) {
        const Part& part = patch.scene.parts[i];
        const auto found = placement_at.find({part.node, part.source_mesh});
        // The first part of a placement keeps its node; split-off parts get new nodes.
        if (part.document == patch.base && found != placement_at.end() && claims.claimed[found->second] < 0)
            claims.claimed[found->second] = static_cast<int>(i);
    }
    move_skins(patch, claims, skin_moves);
    return claims;
}

// --- Levels of detail in the same file: MSFT_lod.

namespace {

/// "bust.lod2" is level 2 of "bust"; 0 for other names.
std::pair<std::string, std::size_t> level_of(const std::string& name) {
    const auto at = name.rfind(".lod");
    if (at == std::string::npos || at + 4 == name.size() || name.size() - at > 4 + 6) return {name, 0};
    std::size_t level = 0;
    for (const char c : name.substr(at + 4)) {
        if (c < '0' || c > '9') return {name, 0};
        level = 10 * level + static_cast<std::size_t>(c - '0');
    }
    return {name.substr(0, at), level};
}

using Levels = std::map<std::size_t, std::size_t>; ///< parts by level

/// The levels of each part that has levels.
std::map<std::size_t, Levels> levels_by_part(const std::vector<Part>& parts) {
    std::map<std::string, std::size_t> named;
    for (std::size_t i = 0; i < parts.size(); ++i) named.emplace(parts[i].name, i);
    std::map<std::size_t, Levels> all;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [base, level] = level_of(parts[i].name);
        const auto found = named.find(base);
        if (level > 0 && found != named.end()) all[found->second].emplace(level, i);
    }
    return all;
}

/// Removes a level from the scenes' roots, because it is shown only instead of its node.
void unroot(Json& document, std::size_t node) {
    for (auto& scene : document["scenes"]) {
        if (!scene.contains("nodes")) continue;
        Json kept = Json::array();
        for (const auto& root : scene["nodes"])
            if (root != node) kept.push_back(root);
        scene["nodes"] = std::move(kept);
    }
}

/// Sets the transform of a level relative to the parent of the node that it replaces.
void place_level(Json& node, const NodeFrame* parent, const Transform& world) {
    const auto up = parent ? inverse(parent->world) : Transform{};
    if (!up) return;
    const Transform local = *up * world;
    for (const char* key : {"translation", "rotation", "scale", "matrix"}) node.erase(key);
    if (!local.identity()) node["matrix"] = matrix(local);
}

/// The share of the screen under the bounding sphere, if the error is as many pixels as allowed. The angle of
/// view does not matter, because it scales both.
double coverage_of(double radius, double error, const LevelSettings& s) {
    if (!(error > 0)) return 1;
    const double pixels = radius / error * s.pixels;
    return std::min(1.0, pi * pixels * pixels / (s.width * s.height));
}

/// Writes when levels change, and their distances from level 0. At least as much coverage as the number of a
/// level shows this level.
void put_coverage(Patch& patch, Json& node, std::size_t base, const std::vector<std::size_t>& levels) {
    const std::vector<Part>& parts = patch.scene.parts;
    const Json::json_pointer own("/extras/MSFT_screencoverage");
    const bool changed = parts[base].changed || std::any_of(levels.begin(), levels.end(),
                                                            [&](std::size_t i) { return parts[i].changed; });
    if (!changed && node.contains(own) && node[own].size() == levels.size() + 1) return;
    const Surface finest = surface_of(parts[base]);
    const double radius = finest.bounds().diagonal() / 2;
    Json coverage = Json::array(), errors = Json::array({0.0});
    double last = 1;
    for (const std::size_t level : levels) {
        const double error = deviation(finest, surface_of(parts[level]), {.means = false}).maximum();
        if (!std::isfinite(error) || !(radius > 0)) return;
        last = std::min(last, coverage_of(radius, error, patch.settings.lods));
        coverage.push_back(last);
        errors.push_back(error);
    }
    coverage.push_back(0.0);
    Json& extras = node["extras"];
    if (!extras.is_object()) extras = Json::object();
    extras["MSFT_screencoverage"] = std::move(coverage);
    extras["lod_errors"] = std::move(errors);
}

/// Turns parts X.lod1, X.lod2, ... into levels of X.
void patch_levels(Patch& patch, const Claims& claims, const std::vector<int>& node_of_part) {
    if (!patch.settings.lods.on) return;
    Json& document = patch.builder.json();
    const auto all = levels_by_part(patch.scene.parts);
    const auto frames = node_frames(document);
    std::size_t linked = 0;
    for (const auto& [base, levels] : all) {
        if (node_of_part[base] < 0) continue;
        const auto& frame = frames[static_cast<std::size_t>(node_of_part[base])];
        const auto* parent = frame.parent < 0 ? nullptr : &frames[static_cast<std::size_t>(frame.parent)];
        Json ids = Json::array();
        std::vector<std::size_t> parts;
        for (const auto& [level, part] : levels) {
            if (node_of_part[part] < 0) continue;
            parts.push_back(part);
            const auto node = static_cast<std::size_t>(node_of_part[part]);
            ids.push_back(node);
            ++linked;
            if (frames[node].parent >= 0) continue; // the node is already in the hierarchy
            unroot(document, node);
            if (!patch.scene.parts[part].skinned)
                place_level(document["nodes"][node], parent,
                            node_world(patch, claims, patch.scene.parts[part]));
        }
        Json& node = document["nodes"][static_cast<std::size_t>(node_of_part[base])];
        put_coverage(patch, node, base, parts);
        node["extensions"]["MSFT_lod"] = {{"ids", ids}};
    }
    if (linked > 0)
        patch.builder.use_extension("MSFT_lod", false);
    else
        patch.warn("W-LODS", "there are no levels of detail to write: no two parts are called X and X.lod1",
                   "simplify: {lods: [100%, 25%, 5%]} makes them");
}

/// Drops nodes that lost their mesh and have nothing else.
void drop_emptied_nodes(Patch& patch, const Claims& claims, std::vector<int>& node_of_part) {
    Json& document = patch.builder.json();
    if (has_unknown_extensions(document) || uses_extension(document, "KHR_animation_pointer")) return;
    std::set<std::size_t> emptied;
    for (const Placement& placement : claims.placements) {
        const auto node = static_cast<std::size_t>(placement.node);
        if (placement.node < 0 || document["nodes"][node].contains("mesh")) continue;
        emptied.insert(node);
        Json& extensions = document["nodes"][node]["extensions"]; // a missing one is dropped as null
        for (const char* name : {instancing_extension, instance_features})
            if (extensions.is_object()) extensions.erase(name);
        if (extensions.empty()) document["nodes"][node].erase("extensions");
    }
    const std::size_t count = count_of(document, "nodes");
    const auto numbers = numbers_without(count, erase_empty_nodes(document, emptied));
    for (int& node : node_of_part)
        if (node >= 0) node = numbers[static_cast<std::size_t>(node)];
}

} // namespace

PartNodes patch_nodes(Patch& patch, PartMeshes meshes) {
    const Claims& claims = meshes.claims;
    std::vector<char> placed(patch.scene.parts.size());
    std::vector<int> nodes(placed.size(), -1);
    for (std::size_t p = 0; p < claims.placements.size(); ++p) {
        const int part = claims.claimed[p], node = claims.placements[p].node;
        if (part >= 0) {
            placed[static_cast<std::size_t>(part)] = true;
            nodes[static_cast<std::size_t>(part)] = node;
        }
        if (node >= 0)
            set_mesh(patch, static_cast<std::size_t>(node), claims.placements[p], part,
                     part < 0 ? -1 : meshes.of_part[static_cast<std::size_t>(part)]);
    }
    if (patch.base >= 0) {
        move_nodes(patch, claims);
        drop_dead_weights(patch);
    }
    for (std::size_t i = 0; i < placed.size(); ++i)
        if (!placed[i])
            nodes[i] = static_cast<int>(add_node(patch, claims, patch.scene.parts[i], meshes.of_part[i]));
    patch_levels(patch, claims, nodes);
    drop_dead_meshes(patch, meshes);
    drop_emptied_nodes(patch, claims, nodes);
    return {std::move(nodes), std::move(meshes.images)};
}

} // namespace facetmill::io::gltf
