#pragma once
// Alpha wrapping. This header does not include CGAL, which does the work.

#include "mesh/mesh.hpp"

#include <array>
#include <vector>

namespace facetmill {

/// Triangles, segments and points, in any state.
struct WrapInput {
    std::vector<Vec3> positions;
    std::vector<std::array<Index, 3>> triangles; ///< without exactly collinear triangles
    std::vector<std::array<Index, 2>> segments;
    std::vector<Index> points;
};

struct WrapSize {
    double alpha = 0, offset = 0;   ///< above 0
    std::size_t max_vertices = 0;   ///< of the tetrahedra; the wrap has fewer vertices
    std::size_t about_vertices = 0; ///< expected, for the progress
};

struct WrappedSurface {
    std::vector<Vec3> points;
    std::vector<std::array<Index, 3>> triangles;
    bool too_large = false; ///< stopped at max_vertices; all else is empty
};

/// Carves a Delaunay triangulation from outside, through triangles whose smallest circumscribed ball has at
/// least the radius alpha, and refines it with points at the distance `offset` from the input (P. Alliez, D.
/// Cohen-Steiner, M. Hemmer, C. Portaneri and M. Rouxel-Labbe, "Alpha wrapping with an offset", 2022). The
/// result is the border of cells of a Delaunay triangulation, so it is closed, oriented and free of
/// self-intersections, and CGAL makes it manifold. Single-threaded and deterministic.
[[nodiscard]] WrappedSurface alpha_wrap(const WrapInput& input, const WrapSize& size);

} // namespace facetmill
