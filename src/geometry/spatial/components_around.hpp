#pragma once
// Finds the components of a surface that enclose a point.

#include "geometry/spatial/face_tree.hpp"

#include <functional>
#include <vector>

namespace facetmill {

/// The counted components with a nonzero winding number around p, ascending, by a ray along an axis. A
/// closed component winds around p if p is inside it. p may be on components that are not counted. tree: the
/// tree for rays. component_of: [faces]. Exact.
[[nodiscard]] std::vector<Index> components_around(const FaceTree& tree, const Vec3& p,
                                                   const std::vector<Index>& component_of,
                                                   const std::function<bool(Index component)>& counts);

} // namespace facetmill
