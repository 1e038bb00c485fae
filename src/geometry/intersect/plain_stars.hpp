#pragma once
// Vertices around which a surface is so plain that its triangles there need not be compared with each other.

#include "mesh/surface.hpp"

#include <cstdint>
#include <vector>

namespace facetmill {

/// [vertices] 1 where the triangles around the vertex, seen along an axis, all turn the same way and go round
/// it at most once, each vertex beside it being the second of one triangle at most and the third of one at
/// most. Seen so, no two of them have more in common than the vertex, or the edge that they share by its
/// vertices; so they meet nowhere else in space either. Signs are those that floating point is sure of: 0
/// says nothing. Parallel.
std::vector<std::uint8_t> plain_stars(const Surface& surface);

} // namespace facetmill
