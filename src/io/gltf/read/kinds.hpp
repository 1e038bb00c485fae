#pragma once
// Meshes with primitives of several kinds.

#include "io/gltf/document/json.hpp"

namespace facetmill::io::gltf {

/// Gives a mesh one kind of primitives: of triangles, lines or points. If it has several kinds, the lines
/// move to a mesh of their own, and so does each primitive of points. Each node of the mesh gets a child with
/// each new mesh, and with the node's skin, morph weights and instances, so that all become parts.
/// Returns true if the document has changed. Throws malformed.
bool part_kinds(Json& document);

} // namespace facetmill::io::gltf
