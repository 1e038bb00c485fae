#pragma once
// Makes wedges and face offsets explicit if a mesh omits them.

#include "mesh/mesh.hpp"

namespace facetmill {

/// [wedges] The vertices, even if the mesh has no seams.
[[nodiscard]] std::vector<Index> explicit_wedges(const Mesh& mesh);
/// [faces + 1] The first corners, even if all faces are triangles.
[[nodiscard]] std::vector<Index> explicit_offsets(const Mesh& mesh);

} // namespace facetmill
