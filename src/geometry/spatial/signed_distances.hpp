#pragma once
// Signed distances to a surface.

#include "geometry/spatial/face_tree.hpp"

#include <span>

namespace facetmill {

/// The distance of each point to the nearest triangle of the tree: positive on the triangle's front side,
/// negative on its back. 0 for points that are not finite, and for an empty tree. Parallel, O(n log n).
[[nodiscard]] std::vector<float> signed_distances(const FaceTree& tree, std::span<const Vec3> points);

} // namespace facetmill
