#pragma once
// CGAL's own answers, for comparison.

#include "mesh/mesh.hpp"

#include <utility>
#include <vector>

namespace facetmill::oracle {

/// The pairs of faces that CGAL's Polygon_mesh_processing::self_intersections finds on an edge-manifold,
/// oriented triangle mesh, each (lower, higher), sorted.
std::vector<std::pair<Index, Index>> self_intersections(const Mesh& mesh);

} // namespace facetmill::oracle
