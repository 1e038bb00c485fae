#pragma once
// Which components of a surface are around a point.

#include "geometry/spatial/face_tree.hpp"

#include <functional>
#include <vector>

namespace facetmill {

/// The components, of those that count, that wind around p by a ray along an axis, ascending: for a closed
/// one, p lies inside. p may lie on components that do not count. tree: for rays; component_of: [faces].
/// Exact.
std::vector<Index> components_around(const FaceTree& tree, const Vec3& p,
                                     const std::vector<Index>& component_of,
                                     const std::function<bool(Index component)>& counts);

} // namespace facetmill
