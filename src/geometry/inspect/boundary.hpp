#pragma once
// The borders of a surface: chains of edges with a face on one side only.

#include "mesh/topology.hpp"

#include <vector>

namespace facetmill {

/// Open edges that hang together by their vertices: a loop, or several that touch.
struct BoundaryChain {
    std::size_t edges = 0;
    double length = 0;
    Index face = none; ///< at the chain's first edge
    Vec3 at;           ///< the middle of that edge
};

/// By their lowest vertex. O(n log n).
std::vector<BoundaryChain> boundary_chains(const Mesh& mesh);

} // namespace facetmill
