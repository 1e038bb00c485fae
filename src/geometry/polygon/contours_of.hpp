#pragma once
// Rings as CGAL's bridges take them.

#include "geometry/cgal/triangulate_polygon.hpp"

namespace facetmill::polygon {

/// The corners of the rings in order, each with an edge to the next of its ring.
Contours contours_of(Rings rings);

} // namespace facetmill::polygon
