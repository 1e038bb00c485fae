#pragma once
// Distances to a surface that tell its sides.

#include "geometry/spatial/face_tree.hpp"

#include <span>

namespace facetmill {

/// The distance of each point to the nearest triangle of the tree: positive on the side to which that looks,
/// negative on the other; 0 for what is not finite, and where the tree is empty. In parallel, O(n log n).
[[nodiscard]] std::vector<float> signed_distances(const FaceTree& tree, std::span<const Vec3> points);

} // namespace facetmill
