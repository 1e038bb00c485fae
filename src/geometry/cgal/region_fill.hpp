#pragma once
// Triangulates regions of a plane, given by their borders. Only for this folder.

#include "geometry/cgal/plane_cut.hpp"
#include "geometry/polygon/polygon.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace facetmill {

/// The two axes onto which a plane is projected along the third, seen from where a triangle in it turns
/// left.
struct PlaneView {
    std::size_t u = 0, v = 1;
    Vec2 flat(const Vec3& p) const { return {p[u], p[v]}; }
};

/// The axes in order, starting with the best projection axis for a plane with this approximate normal.
[[nodiscard]] std::array<std::size_t, 3> axes_by(const Vec3& rough_normal);
/// The view of the plane of a triangle with area.
[[nodiscard]] PlaneView view_of(const std::array<Vec3, 3>& corners);

/// A region between points of the plane.
struct FlatRegion {
    using Edge = std::array<Index, 2>;
    std::vector<Vec2> points; ///< the error of each coordinate is at most 2^-52 of the largest coordinate
    std::vector<Edge>
        border; ///< the region is on the left of each edge; with exact coordinates they do not cross
    std::vector<Edge> lines; ///< lines in the region, which do not cross either
};

/// Decides by exact numbers.
inline bool turns_left(const ExactKernel::Point_2& a, const ExactKernel::Point_2& b,
                       const ExactKernel::Point_2& c) {
    return CGAL::orientation(a, b, c) == CGAL::LEFT_TURN;
}

using FlatTriangles = std::vector<std::array<Index, 3>>;

/// The constrained Delaunay triangulation of the region, whose points must all be in it or on its border, by
/// rounded coordinates. The result is then proved for the true coordinates by certain signs of doubles, or
/// by `is_left` for the few uncertain triangles. Returns none if the proof fails, which implies nothing
/// about the region. The proof: all triangles turn left. Their edges pair up except border edges, so that
/// they cover the region once. Each line is an edge, and each point a corner.
[[nodiscard]] std::optional<FlatTriangles>
proved_filling(const FlatRegion& region, const std::function<bool(Index, Index, Index)>& is_left);

/// Like the previous function, with exact numbers: `points` replace the region's points. Returns none only
/// if the border does not close, or lines cross that must not.
[[nodiscard]] std::optional<FlatTriangles> exact_filling(const FlatRegion& region,
                                                         const std::vector<ExactKernel::Point_2>& points);

/// Triangulates a region of the arrangement, whose corners are nodes. Uses exact numbers if the proof with
/// doubles fails.
[[nodiscard]] std::optional<FlatTriangles> fill_region(const ExactNodes& nodes,
                                                       const Arrangement::Region& region);

} // namespace facetmill
