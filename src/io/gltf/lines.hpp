#pragma once
// The lines of a glTF document.

#include "io/codec.hpp"
#include "io/gltf/accessor.hpp"
#include "io/gltf/nodes.hpp"

namespace facetmill::io::gltf {

/// True for primitives that make lines (lists, loops and strips) of positions.
bool makes_lines(const Place& primitive);

/// The lines of each node's mesh where they stand in the world, named after the node, or else the mesh.
/// Materials are the document's. The document keeps them as they are. Throws malformed, and limit beyond
/// max_vertices points.
std::vector<Lines> decode_lines(Source& source, const std::vector<NodeFrame>& frames,
                                std::size_t max_vertices);

} // namespace facetmill::io::gltf
