#pragma once
// How contours in the plane meet themselves. Free of CGAL, which does the work behind it.

#include "geometry/cgal/triangulate_polygon.hpp"

namespace facetmill {

/// How the edges of contours meet elsewhere than in the points that they share (see polygon::Contact; points
/// at one place are not shared). By constrained triangulation, which ends at the first edge that crosses
/// another: n log n and the triangles that edges run through, however their boxes overlap. Exact.
polygon::Contact contact_of(const Contours& contours);

} // namespace facetmill
