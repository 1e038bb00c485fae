#include "io/gltf/document/roots.hpp"

#include "io/gltf/document/nodes.hpp"

#include <map>

namespace facetmill::io::gltf {

void put_matrix(Json& node, const Transform& local) {
    for (const char* key : {"translation", "rotation", "scale", "matrix"}) node.erase(key);
    if (!local.identity()) node["matrix"] = matrix(local);
}

namespace {

/// Whether a node only moves its children, and no animation drives it, because these drive no matrices.
bool only_moves_children(const Json& node) {
    return node.is_object() && node.size() == 2 && node.contains("matrix") && node.contains("children");
}

} // namespace

std::set<std::size_t> joint_nodes(const Json& document) {
    std::set<std::size_t> joints;
    for (std::size_t s = 0; s < count_of(document, "skins"); ++s) {
        const Json& skin = document["skins"][s];
        if (!skin.is_object() || !skin.contains("joints")) continue;
        for (const Json& joint : skin["joints"])
            if (joint.is_number_unsigned()) joints.insert(joint.get<std::size_t>());
    }
    return joints;
}

namespace {

/// The roots of a scene; empty for an invalid list.
std::vector<std::size_t> roots_of(const Json& scene, std::size_t nodes) {
    std::vector<std::size_t> roots;
    if (!scene.is_object() || !scene.contains("nodes") || !scene["nodes"].is_array()) return roots;
    for (const Json& root : scene["nodes"])
        if (root.is_number_unsigned() && root.get<std::size_t>() < nodes)
            roots.push_back(root.get<std::size_t>());
    return roots;
}

} // namespace

void put_above_roots(Json& document, const Transform& t) {
    const std::size_t count = count_of(document, "nodes");
    if (count_of(document, "scenes") == 0 && count > 0) { // viewers then show all nodes
        const auto frames = node_frames(document);
        std::vector<std::size_t> roots;
        for (std::size_t n = 0; n < count; ++n)
            if (frames[n].parent < 0) roots.push_back(n);
        document["scenes"] = Json::array({{{"nodes", roots}}});
        document["scene"] = 0;
    }
    std::map<std::size_t, std::size_t> uses; // a node may be a root of several scenes
    for (std::size_t s = 0; s < count_of(document, "scenes"); ++s)
        for (const std::size_t root : roots_of(document["scenes"][s], count)) ++uses[root];
    const auto node_above = [&](const std::vector<std::size_t>& children) {
        document["nodes"].push_back({{"children", children}, {"matrix", matrix(t)}});
        return document["nodes"].size() - 1;
    };
    std::map<std::size_t, std::size_t> above_shared;
    for (std::size_t s = 0; s < count_of(document, "scenes"); ++s) {
        std::vector<std::size_t> roots, own;
        for (const std::size_t root : roots_of(document["scenes"][s], count)) {
            if (uses[root] == 1) {
                own.push_back(root);
                continue;
            }
            const auto [at, fresh] = above_shared.try_emplace(root);
            if (fresh) at->second = node_above({root});
            roots.push_back(at->second);
        }
        if (own.size() == 1 && only_moves_children(document["nodes"][own[0]])) {
            Json& root = document["nodes"][own[0]];
            put_matrix(root, t * local_transform(JsonCursor(root, "")));
            roots.push_back(own[0]);
        } else if (!own.empty()) {
            roots.push_back(node_above(own));
        }
        if (!roots.empty()) document["scenes"][s]["nodes"] = roots;
    }
}

} // namespace facetmill::io::gltf
