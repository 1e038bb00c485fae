#pragma once
// Fills any number of closed contours in the plane: nested, touching, crossing or running along each other.
// This header does not include CGAL, which does the work.

#include "geometry/polygon/polygon.hpp"

#include <array>

namespace facetmill {

/// Directed edges between points, with counts. As many edges arrive at every point as leave it.
struct Contours {
    struct Edge {
        Index from = 0, to = 0; ///< points
        int count = 1;          ///< number of times; negative: in the opposite direction
    };
    std::vector<Vec2> points;
    std::vector<Edge> edges;
};

/// Triangles between the points and the points that had to be added where edges cross.
struct Filling {
    struct Added {
        Vec2 at;
        Index edge; ///< an edge that contains the point
        double t;   ///< position on the edge: 0 at `from`, 1 at `to`
    };
    /// Counter-clockwise. Each triangle occurs once per turn of the contours around it, and is reversed if
    /// they turn clockwise.
    std::vector<std::array<Index, 3>> triangles;
    std::vector<Index> same;  ///< [points] the lowest point at the same position; triangles use only these
    std::vector<Added> added; ///< numbered after the points
    std::vector<Index> path_offsets; ///< [edges + 1] into path
    std::vector<Index> path; ///< the points strictly between the ends of each edge, from its from to its to
};

/// Constrained Delaunay triangulation with exact predicates. Requires finite coordinates. For any input, the
/// boundary of the triangles consists exactly of the edges along their paths (coincident points count as
/// merged). Deterministic.
[[nodiscard]] Filling fill(const Contours& contours);

} // namespace facetmill
