#pragma once
// Cuts a triangle along a few lines with floating point only, if the result is certainly correct.

#include "geometry/polygon/polygon.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace facetmill::polygon {

/// Whether the points certainly turn left, although each coordinate may differ by `off` from its true value.
/// The error of a difference is at most d = 2 off + 2^-53 of it, from both ends and rounding. The error of a
/// product of two differences of at most `size` is then at most 2 size d + d^2, and the error of a turn 10
/// size d. (If d is not small compared to the size, the bound exceeds any determinant.)
bool surely_left(const Vec2& a, const Vec2& b, const Vec2& c, double off);

/// The input of a triangulation. Coordinates may differ from their true values by 2^-52 of their size;
/// corners are exact.
struct CutTriangle {
    std::vector<Vec2> points;        ///< the corners first, anticlockwise
    std::vector<std::uint8_t> sides; ///< [points] bit k: exactly on the side from corner k to the next corner
    std::vector<std::array<Index, 2>> lines; ///< lines between points
};

/// The constrained Delaunay triangulation by doubles; where points are nearly on a common circle, any choice.
/// Certain signs of doubles prove that it is a triangulation for the true coordinates. None if the proof
/// fails; the triangulation may be correct even then. Triangles are anticlockwise, in no order. The proof:
/// all triangles turn left. Their edges pair up, except along the sides, so they cover the triangle once.
/// Each line is an edge. None for more than 48 points.
[[nodiscard]] std::optional<std::vector<std::array<Index, 3>>> certain_triangulation(const CutTriangle& cut);

/// The edges along the sides, anticlockwise, from point to point, as `sides` defines. None if their order is
/// uncertain.
[[nodiscard]] std::optional<std::vector<std::array<Index, 2>>> certain_border(const CutTriangle& cut);

/// The pairs of lines that cross between their ends, each with the lower line first, ascending. None if
/// certain signs do not decide every pair. Lines along the same side, and lines with a common end, do not
/// cross.
[[nodiscard]] std::optional<std::vector<std::array<Index, 2>>> certain_crossings(const CutTriangle& cut);

} // namespace facetmill::polygon
