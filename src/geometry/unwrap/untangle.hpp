#pragma once
// Turns flipped triangles of a flat mesh.

#include "geometry/unwrap/surface.hpp"
#include "mesh/topology.hpp"

namespace facetmill::unwrap_room {

/// The triangles around each point. corners: [3 * faces] points.
[[nodiscard]] VertexLists triangles_around(const std::vector<Index>& corners, std::size_t points);

/// Moves the corners of triangles that are flipped or nearly so. Each goes to a place where the worst
/// triangle around it is best, found by a search along the axes (after L. A. Freitag and P. Plassmann, "Local
/// optimization-based simplicial mesh untangling and improvement", 2000). Gives up where many are flipped.
/// corners: [3 * faces] points.
void untangle_triangles(const std::vector<Index>& corners, const std::vector<FlatShape>& shapes,
                        std::vector<Vec2>& points);

} // namespace facetmill::unwrap_room
