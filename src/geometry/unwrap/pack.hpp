#pragma once
// Packs charts into a square.

#include "geometry/unwrap/chart.hpp"
#include "geometry/unwrap/unwrap.hpp"

#include "geometry/polygon/polygon.hpp"

namespace facetmill::unwrap_room {

/// A chart to be packed, with its longer side along x and coordinates from 0.
struct PackItem {
    std::vector<Index> corners; ///< points, three per triangle
    std::vector<Vec2> points;
    std::vector<BorderEdge> border; ///< for the test after rounding
    Vec2 size;                      ///< of its box
    double area = 0;                ///< of its triangles
};

/// Where a chart goes: quarter turns, then a shift, in cells.
struct PackedItem {
    int turns = 0;
    std::size_t x = 0, y = 0;
    std::size_t width = 0, height = 0; ///< of the mask before the turns
};

struct Packing {
    std::vector<PackedItem> items;
    double scale = 0;        ///< cells per unit
    std::size_t texture = 0; ///< side of the square, in texels
    std::size_t cell = 1;    ///< texels along the side of a cell

    /// The place of a point of an item, in texels.
    Vec2 place(const PackedItem& item, const Vec2& point) const;
};

/// Places charts from the largest to the smallest, each with the quarter turn and at the place that keeps the
/// strip lowest; the scale is searched so that the strip fills the square. Charts are sets of cells, so they
/// fill the concavities of others (after the horizons of B. Levy, S. Petitjean, N. Ray and J. Maillot, "Least
/// squares conformal maps for automatic texture atlas generation", 2002).
[[nodiscard]] Packing pack(const std::vector<PackItem>& items, const UnwrapSettings& settings);

} // namespace facetmill::unwrap_room
