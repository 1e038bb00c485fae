#pragma once
// Polygons with holes, and any other set of rings, into triangles with their winding numbers: constrained
// Delaunay by CGAL, behind a header without it.

#include "geometry/polygon/polygon.hpp"

#include <array>
#include <optional>

namespace facetmill::polygon {

/// A point where edges cross that is no corner of a ring.
struct AddedPoint {
    Vec2 at;        ///< rounded to doubles; triangles around it may be off by that rounding
    Index edge = 0; ///< the first edge through it: number of its first corner, counted through all rings
    double t = 0;   ///< how far along it: 0 at its first corner, 1 at its second
};

/// Triangles that cover all the rings wind around, none twice.
struct Triangulation {
    std::vector<std::array<Index, 3>>
        triangles; ///< anticlockwise; corners counted through all rings, then added points; coincident
                   ///< corners are represented by the first of them
    std::vector<int> winding; ///< [triangles] how often the rings go round it; never 0
    std::vector<AddedPoint> added;
};

/// Rings may touch, overlap and cross; corners may coincide. Exact predicates; where edges cross, exact
/// constructions too. Any fill rule is a choice of windings: odd ones, all, the positive. Rings without area
/// give no triangles.
[[nodiscard]] Triangulation triangulate_rings(Rings rings);

/// The least and the largest winding number of any point that is not on the rings; 0 is always among them.
/// Exact.
struct WindingRange {
    int min = 0, max = 0;
};
[[nodiscard]] WindingRange winding_range(Rings rings);

/// Of what a ring that may cross itself winds around, each point counted once, however often and whichever
/// way (nonzero rule). None when that has no area.
[[nodiscard]] std::optional<Moments> moments_by_winding(Ring ring);

} // namespace facetmill::polygon
