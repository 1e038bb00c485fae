#include "io/gltf/animated.hpp"

#include "io/gltf/nodes.hpp"

namespace facetmill::io {

namespace {

/// The animated nodes of a document and all below them.
std::set<int> moving_nodes(const Document& document) {
    const Json json = gltf::parse_document(document.json);
    const auto animated = gltf::animated_nodes(json);
    std::set<int> moving;
    if (animated.empty()) return moving;
    const auto frames = gltf::node_frames(json);
    for (const std::size_t n : gltf::parents_first(frames))
        if (animated.contains(n) || moving.contains(frames[n].parent)) moving.insert(static_cast<int>(n));
    return moving;
}

} // namespace

std::vector<bool> animated_parts(const Scene& scene) {
    std::vector<std::set<int>> moving;
    for (const auto& document : scene.documents) moving.push_back(moving_nodes(*document));
    std::vector<bool> animated;
    for (const Part& part : scene.parts)
        animated.push_back(part.document >= 0 && part.node >= 0 &&
                           moving.at(static_cast<std::size_t>(part.document)).contains(part.node));
    return animated;
}

} // namespace facetmill::io
