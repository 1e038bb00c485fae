#pragma once
// Joins neighbouring flat charts while the result stays valid.

#include "geometry/unwrap/charts.hpp"

namespace facetmill::unwrap_room {

/// Joins charts along their longest common border, if the joined chart passes: it is valid, its stretch is
/// at most max_stretch, and it fills enough of its convex hull to be packed well.
void join_charts(const UnwrapSurface& surface, double max_stretch, ChartSet& set);

} // namespace facetmill::unwrap_room
