#pragma once
// The neighbours of every vertex in compressed form, as the smoothing methods need them.

#include "geometry/relax.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

struct Neighbourhoods {
    VertexLists lists;    ///< neighbours of each vertex, ascending, each once; empty for those that stay
    std::size_t held = 0; ///< boundary vertices whose list is empty because the boundary is fixed
};

/// Only neighbours and boundary of the settings count. Parallel, O(corners) for faces of bounded size.
Neighbourhoods neighbourhoods(const Mesh& mesh, const RelaxSettings& settings);

/// One byte per vertex: 1 when it is the end of an edge that has exactly one face.
std::vector<std::uint8_t> boundary_vertices(const Mesh& mesh);

} // namespace facetmill
