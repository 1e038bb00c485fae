#pragma once
// Finds the vertices of a crack that are on the edges along it.

#include "geometry/edit/surgery.hpp"

namespace facetmill {

/// The vertices on a boundary edge of another face that have a boundary edge of their own along it. On means
/// exactly, or within tolerance and farther than that from its ends. The result is the input of
/// insert_on_edges. By edge; a vertex may be on several. O(n log n).
[[nodiscard]] std::vector<Insertion> find_t_junctions(const Mesh& mesh, double tolerance);

} // namespace facetmill
