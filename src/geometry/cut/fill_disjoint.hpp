#pragma once
// Fills contours of a mesh. Coincident vertices stay separate.

#include "geometry/cgal/triangulate_polygon.hpp"

namespace facetmill {

/// Like `fill`, with zero-area triangles between coincident points where needed. The boundary of all
/// triangles is exactly the edges along their paths, with coincident points counted separately.
[[nodiscard]] Filling fill_disjoint(const Contours& contours);

} // namespace facetmill
