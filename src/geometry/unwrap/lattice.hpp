#pragma once
// Rounds a packed chart to coordinates that float32 holds exactly.

#include "geometry/unwrap/chart.hpp"

namespace facetmill::unwrap_room {

/// Steps of the lattice along the side of the square: float32 holds every multiple of 2^-24 in [0, 1].
inline constexpr double lattice_steps = 16777216;

/// Rounds the points to whole steps, and moves points by a few steps where rounding flips a triangle. Returns
/// whether the chart is valid afterwards, by exact tests.
[[nodiscard]] bool round_to_lattice(const std::vector<Index>& corners, const std::vector<BorderEdge>& border,
                                    std::vector<Vec2>& points);

} // namespace facetmill::unwrap_room
