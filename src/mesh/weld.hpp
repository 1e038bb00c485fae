#pragma once
// Finds coincident vertices, for algorithms that do not merge them.

#include "mesh/mesh.hpp"

namespace facetmill {

/// For each vertex, the lowest vertex at the same position (-0 is 0). Empty if all positions differ.
/// Parallel.
[[nodiscard]] std::vector<Index> first_at_position(const std::vector<Vec3>& positions);

} // namespace facetmill
