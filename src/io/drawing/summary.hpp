#pragma once
// What a report says of a drawing's sections.

#include "io/drawing/drawing.hpp"

#include <array>

namespace facetmill::io {

/// Sums over all sheets and parts.
struct DrawingTotals {
    double area = 0;
    std::size_t contours = 0, open = 0, holes = 0;
    std::size_t touched = 0; ///< contours that shrank to a point or line
    std::size_t empty = 0;   ///< sheets without contours
    bool oriented = true;
    std::array<std::size_t, polygon::kinds> kinds{}; ///< of closed contours

    std::size_t count(polygon::Kind kind) const { return kinds[static_cast<std::size_t>(kind)]; }
};
DrawingTotals totals_of(const Drawing& drawing);

/// The totals, the frame of the first sheet, and every sheet with its area; the measures of the first 200
/// contours (a JSON drawing has all).
Json summary_json(const Drawing& drawing, const DrawingTotals& totals);

} // namespace facetmill::io
