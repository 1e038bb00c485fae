#pragma once
// A triangle cut along a few lines, by floating point alone where that is sure to be right.

#include "geometry/polygon/polygon.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace facetmill::polygon {

/// Whether the points surely turn left, where each coordinate may differ by `off` from the true one. A
/// difference of two is wrong by at most d = 2 off + 2^-53 of it, by both ends and by rounding; then a
/// product of two of at most `size` is by 2 size d + d^2, and a turn by 10 size d. (Where d is not small
/// beside the size, the bound exceeds any determinant.)
bool surely_left(const Vec2& a, const Vec2& b, const Vec2& c, double off);

/// The input of a triangulation. Coordinates may differ from the true ones by 2^-52 of their size; corners
/// are exact.
struct CutTriangle {
    std::vector<Vec2> points;                ///< the corners first, anticlockwise
    std::vector<std::uint8_t> sides;         ///< [points] bit k: truly on the side from corner k to the next
    std::vector<std::array<Index, 2>> lines; ///< between points
};

/// Its constrained Delaunay triangulation, as far as doubles tell: where points are nearly on one circle,
/// any. That it is a triangulation for the true coordinates is proved by signs that doubles are sure of; else
/// none, which says nothing. Triangles are anticlockwise, in no order. However they are found, these make
/// them right: they turn left; their edges pair up but for those along the sides, so that they cover the
/// triangle once; and each line is an edge. For a few points: none for more than 48.
[[nodiscard]] std::optional<std::vector<std::array<Index, 3>>> certain_triangulation(const CutTriangle& cut);

/// The edges along the sides, anticlockwise, from point to point: those that sides tells, in an order that is
/// sure; else none.
[[nodiscard]] std::optional<std::vector<std::array<Index, 2>>> certain_border(const CutTriangle& cut);

/// The pairs of lines that cross between their ends, lower one first, ascending, as signs prove for the true
/// coordinates; none where they do not prove of every pair whether it does. Those along one side, and those
/// with an end in common, do not cross.
[[nodiscard]] std::optional<std::vector<std::array<Index, 2>>> certain_crossings(const CutTriangle& cut);

} // namespace facetmill::polygon
