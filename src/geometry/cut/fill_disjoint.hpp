#pragma once
// Fills contours of a mesh, whose coincident vertices remain separate.

#include "geometry/cgal/triangulate_polygon.hpp"

namespace facetmill {

/// fill, with triangles without area between coincident points where needed. The boundary of all triangles
/// is exactly the edges along their paths, with coincident points counted separately.
[[nodiscard]] Filling fill_disjoint(const Contours& contours);

} // namespace facetmill
