#pragma once
// Divides a surface into flat charts.

#include "geometry/unwrap/chart.hpp"

namespace facetmill::unwrap_room {

struct Chart {
    std::vector<Index> faces; ///< ascending
    ChartMeasure measure;
    double perimeter = 0; ///< on the surface
};

struct ChartSet {
    std::vector<Chart> charts; ///< by first face
    Gluing gluing;
};

[[nodiscard]] ChartSet make_charts(const UnwrapSurface& surface, double max_stretch);

} // namespace facetmill::unwrap_room
