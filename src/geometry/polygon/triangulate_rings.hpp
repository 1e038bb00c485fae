#pragma once
// Triangulates polygons with holes, and any other sets of rings, and gives winding numbers. CGAL makes a
// constrained Delaunay triangulation; this header does not include it.

#include "geometry/cgal/triangulate_polygon.hpp"
#include "geometry/polygon/polygon.hpp"

#include <array>
#include <optional>

namespace facetmill::polygon {

/// A point where edges cross that is not a corner of a ring.
struct AddedPoint {
    Vec2 at; ///< rounded to doubles; triangles around it may be off by that rounding
    Index edge =
        0; ///< the first edge through the point: the number of its first corner, counted through all rings
    double t = 0; ///< position along this edge: 0 at its first corner, 1 at its second
};

/// Triangles that cover each point that the rings wind around once.
struct Triangulation {
    std::vector<std::array<Index, 3>>
        triangles; ///< anticlockwise; corners are numbered through all rings, then the added points; the
                   ///< first of coincident corners represents them
    std::vector<int> winding; ///< [triangles] winding number of the rings; never 0
    std::vector<AddedPoint> added;
};

/// Rings may touch, overlap and cross; corners may coincide. Uses exact predicates, and exact constructions
/// where edges cross. Callers select by winding for their fill rule: odd, all or positive. Rings without
/// area give no triangles.
[[nodiscard]] Triangulation triangulate_rings(Rings rings);
/// The same for contours. Corners are numbered as points, and AddedPoint::edge is an edge.
[[nodiscard]] Triangulation triangulate_contours(const Contours& contours);

/// The smallest and the largest winding number of any point off the rings. Far away it is 0, so 0 is always
/// in the range. Exact.
struct WindingRange {
    int min = 0, max = 0;
};
[[nodiscard]] WindingRange winding_range(Rings rings);

/// The moments of the region that a ring winds around, each point counted once (nonzero rule). The ring may
/// cross itself. None if the region has no area.
[[nodiscard]] std::optional<Moments> moments_by_winding(Ring ring);

} // namespace facetmill::polygon
