#pragma once
// How thick a solid is under each of its faces.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// For each face the way from its middle straight in (against its normal) to the first face that is seen from
/// behind; infinity where there is none, or the face has no area. In floating point: a ray that passes
/// exactly through an edge may miss it. Polygons are taken as their triangles. Parallel.
std::vector<double> wall_thickness(const Mesh& mesh);

} // namespace facetmill
