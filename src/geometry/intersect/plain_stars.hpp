#pragma once
// Vertices around which a surface is so plain that its triangles there need not be compared with each other.

#include "mesh/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace facetmill {

enum class Star : std::uint8_t {
    unknown,
    plain,
    ring, ///< plain, and closed: each edge at the vertex has two triangles, which run along it both ways
};

/// [vertices] What the triangles around the vertex are: plain where they, seen along an axis, all turn the
/// same way and go round it at most once, each vertex beside it being the second of one triangle at most and
/// the third of one at most. Seen so, no two of them have more in common than the vertex, or the edge that
/// they share by its vertices; so they meet nowhere else in space either. Signs are those that floating point
/// is sure of: of what is unknown nothing is said. Parallel.
/// corners: three for each triangle, into positions.
[[nodiscard]] std::vector<Star> plain_stars(std::span<const Vec3> positions, std::span<const Index> corners);
[[nodiscard]] inline std::vector<Star> plain_stars(const Surface& surface) {
    return plain_stars(surface.positions, surface.corners);
}

} // namespace facetmill
