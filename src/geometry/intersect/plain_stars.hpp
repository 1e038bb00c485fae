#pragma once
// Finds plain vertices: the triangles around them need not be compared with each other.

#include "mesh/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace facetmill {

enum class Star : std::uint8_t {
    unknown,
    plain,
    ring, ///< plain and closed: each edge at the vertex has two triangles, which run along it in opposite
          ///< directions
};

/// [vertices] The kind of the triangles around the vertex. They are plain if, projected along an axis, all
/// turn in the same direction and go round the vertex at most once. Also, each neighbour is the second
/// corner of at most one triangle and the third of at most one. Then two of the projected triangles have
/// only the vertex, or their shared edge, in common. So they do not meet elsewhere in space either. Uses
/// only certain floating-point signs; otherwise the kind is unknown. Parallel. corners: three for each
/// triangle, as indices of positions.
[[nodiscard]] std::vector<Star> plain_stars(std::span<const Vec3> positions, std::span<const Index> corners);
[[nodiscard]] inline std::vector<Star> plain_stars(const Surface& surface) {
    return plain_stars(surface.positions, surface.corners);
}

} // namespace facetmill
