#pragma once
// The neighbours of every vertex in compressed form, as the smoothing methods need them.

#include "geometry/relax/relax.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

struct Neighbourhoods {
    VertexLists lists; ///< neighbours of each vertex, in a fixed order, each once; empty for those that stay
    std::size_t held = 0; ///< vertices whose list is empty because they are on a fixed boundary, or where
                          ///< features meet or end
    std::vector<std::uint8_t> along; ///< [vertices] 1: moves along its boundary or feature only; may be empty
};

/// Only neighbours, boundary, feature_angle, to_world and whether mask is 0 count. Parallel, O(corners) for
/// faces of bounded size. Throws limit (E-LIMIT) for polygons whose neighbours cannot be counted.
Neighbourhoods neighbourhoods(const Mesh& mesh, const RelaxSettings& settings);

/// One byte per vertex: 1 when it is the end of an edge that has exactly one face.
std::vector<std::uint8_t> boundary_vertices(const Mesh& mesh);

} // namespace facetmill
