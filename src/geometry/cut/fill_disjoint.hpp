#pragma once
// Fills contours of a mesh, whose vertices may share a place and are none the less apart.

#include "geometry/cgal/triangulate_polygon.hpp"

namespace facetmill {

/// fill, with triangles without area between points at one place where they are needed: the boundary of all
/// triangles is exactly the edges along their paths, every point counted as one of its own.
Filling fill_disjoint(const Contours& contours);

} // namespace facetmill
