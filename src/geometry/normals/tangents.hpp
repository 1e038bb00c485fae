#pragma once
// Computes tangents for normal maps.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Gives the mesh new tangents for its normals and the texture coordinates TEXCOORD_{uv_set}, in float32,
/// like glTF viewers (MikkTSpace, with its default threshold). Wedges are split where tangents differ.
/// Corners without a direction of u get (1, 0, 0). None, without a change, if the mesh lacks one of these
/// wedge attributes or has faces other than triangles. O(n log n).
[[nodiscard]] std::optional<AttributeChange> give_tangents(Mesh& mesh, int uv_set);

} // namespace facetmill
