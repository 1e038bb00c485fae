// Levels of detail in one file: MSFT_lod.

#include "io/gltf/patch.hpp"

namespace facetmill::io::gltf {

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

using Levels = std::map<std::size_t, std::size_t>; ///< part by level

/// The levels of each part that has some.
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

/// Out of the scenes' roots: a level is shown in place of its node only.
void unroot(Json& document, std::size_t node) {
    for (auto& scene : document["scenes"]) {
        if (!scene.contains("nodes")) continue;
        Json kept = Json::array();
        for (const auto& root : scene["nodes"])
            if (root != node) kept.push_back(root);
        scene["nodes"] = std::move(kept);
    }
}

/// Stands where its part is, seen from the parent of the node that it stands in for.
void place_level(Json& node, const NodeFrame* parent, const Transform& world) {
    const auto up = parent ? inverse(parent->world) : Transform{};
    if (!up) return;
    const Transform local = *up * world;
    for (const char* key : {"translation", "rotation", "scale", "matrix"}) node.erase(key);
    if (!local.identity()) node["matrix"] = matrix(local);
}

} // namespace

void patch_levels(Patch& patch, const std::vector<int>& node_of_part) {
    if (!patch.settings.lods) return;
    Json& document = patch.builder.json();
    const auto all = levels_by_part(patch.scene.parts);
    const auto frames = node_frames(document);
    std::size_t linked = 0;
    for (const auto& [base, levels] : all) {
        if (node_of_part[base] < 0) continue;
        const auto& frame = frames[static_cast<std::size_t>(node_of_part[base])];
        const auto* parent = frame.parent < 0 ? nullptr : &frames[static_cast<std::size_t>(frame.parent)];
        Json ids = Json::array();
        for (const auto& [level, part] : levels) {
            if (node_of_part[part] < 0) continue;
            const auto node = static_cast<std::size_t>(node_of_part[part]);
            ids.push_back(node), ++linked;
            if (frames[node].parent >= 0) continue; // stands somewhere in the document already
            unroot(document, node);
            if (!patch.scene.parts[part].skinned)
                place_level(document["nodes"][node], parent, patch.scene.parts[part].transform);
        }
        document["nodes"][static_cast<std::size_t>(node_of_part[base])]["extensions"]["MSFT_lod"] = {
            {"ids", ids}};
    }
    if (linked > 0)
        patch.builder.use_extension("MSFT_lod", false);
    else
        patch.warn("W-LODS",
                   "there are no levels of detail to write: no part is called X.lod1 beside a part X",
                   "simplify: {lods: [100%, 25%, 5%]} makes them");
}

} // namespace facetmill::io::gltf
