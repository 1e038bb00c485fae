#pragma once
// Faces that share a piece of the texture.

#include "mesh/mesh.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace facetmill {

/// The pairs of faces, the lower first, whose insides overlap in TEXCOORD_0, ascending; none without such an
/// attribute. Decided exactly; faces that only touch, and those without area in the texture, do not count.
/// Polygons are taken as their triangles. Parallel.
std::optional<std::vector<std::pair<Index, Index>>> uv_overlaps(const Mesh& mesh);

} // namespace facetmill
