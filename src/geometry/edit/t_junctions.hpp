#pragma once
// Where the vertices of a crack lie on the edges along it.

#include "geometry/edit/surgery.hpp"

namespace facetmill {

/// The vertices that lie on a boundary edge of another face, exactly, or within tolerance and farther than
/// that from its ends, and have a boundary edge of their own along it: what insert_on_edges would put where.
/// By edge; a vertex may lie on several. O(n log n).
std::vector<Insertion> find_t_junctions(const Mesh& mesh, double tolerance);

} // namespace facetmill
