#pragma once
// A triangle cut along a few lines, by floating point alone where that is sure to be right.

#include "geometry/polygon/polygon.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace facetmill::polygon {

/// What is to be triangulated. Coordinates may differ from the true ones by 2^-52 of their size, those of the
/// corners not at all.
struct CutTriangle {
    std::vector<Vec2> points;                ///< the corners first, anticlockwise
    std::vector<std::uint8_t> sides;         ///< [points] bit k: truly on the side from corner k to the next
    std::vector<std::array<Index, 2>> lines; ///< between points; they may end at each other
};

/// Its constrained Delaunay triangulation, if it is the only one for the true coordinates, as the signs of
/// doubles prove; else none, which says nothing. Triangles are anticlockwise, in no order. However the
/// triangles are found, these make them right: they turn left; their edges pair up but for those along the
/// sides, so that they cover the triangle once; each line is an edge; and beyond all other edges the corner
/// across is strictly outside the circle. For a few points: none for more than 24.
std::optional<std::vector<std::array<Index, 3>>> certain_delaunay(const CutTriangle& cut);

} // namespace facetmill::polygon
