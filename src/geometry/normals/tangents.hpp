#pragma once
// Tangents for maps of normals.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Gives the mesh new tangents for its normals and the texture coordinates TEXCOORD_{uv_set}, in float32, as
/// viewers of glTF make them (MikkTSpace, with its default threshold). Wedges come apart where tangents do;
/// corners that no direction of u can be told for get (1, 0, 0). None, and nothing changed, when the mesh has
/// not both attributes at wedges, or has other faces than triangles. O(n log n).
[[nodiscard]] std::optional<AttributeChange> give_tangents(Mesh& mesh, int uv_set);

} // namespace facetmill
