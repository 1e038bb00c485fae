#pragma once
// Finds vertices of cracks that are on the opposite edges.

#include "geometry/edit/surgery.hpp"

namespace facetmill {

/// Finds vertices on a boundary edge of another face, if a boundary edge of the vertex runs along that edge.
/// The vertex must be exactly on it, or within the tolerance and farther from its ends. Sorted by edge, as
/// the input of insert_on_edges; a vertex may be on several edges. O(n log n).
[[nodiscard]] std::vector<Insertion> find_t_junctions(const Mesh& mesh, double tolerance);

} // namespace facetmill
