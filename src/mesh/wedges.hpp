#pragma once
// Wedges and offsets of faces, spelled out where a mesh leaves them out.

#include "mesh/mesh.hpp"

namespace facetmill {

/// [wedges] -> vertex, also where the mesh has no seams.
[[nodiscard]] std::vector<Index> explicit_wedges(const Mesh& mesh);
/// [faces + 1] -> the first corner, also where all faces are triangles.
[[nodiscard]] std::vector<Index> explicit_offsets(const Mesh& mesh);

} // namespace facetmill
