#pragma once
// The primitives of a mesh as draw calls.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The number of primitives with faces: a renderer draws each separately.
[[nodiscard]] std::size_t draw_calls(const Mesh& mesh);

/// Merges primitives of the mesh with equal material and attributes, unless they have extras or extensions.
/// Returns whether the mesh changed.
bool join_primitives(Mesh& mesh);

} // namespace facetmill
