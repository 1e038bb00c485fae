#pragma once
// From corners that name a vertex and a key (what else the corner has: indices of a texture point and a
// normal) to wedges: corners that agree in both share one.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <span>

namespace facetmill::io {

inline constexpr std::uint64_t no_key = UINT64_MAX;

struct Wedges {
    std::vector<Index> corners;      ///< [corners] -> wedge
    std::vector<Index> wedge_vertex; ///< [wedges] -> vertex; empty when there are no seams
    std::vector<std::uint64_t> keys; ///< [wedges]; no_key for vertices that no corner uses
};

/// Wedge v is the first one of vertex v; further ones follow in the order of their first corner. O(corners).
Wedges make_wedges(std::size_t vertices, std::vector<Index> corner_vertex,
                   std::span<const std::uint64_t> corner_key);

} // namespace facetmill::io
