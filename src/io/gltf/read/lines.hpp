#pragma once
// The lines of a glTF document.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"

namespace facetmill::io::gltf {

/// The two ends of each line of a primitive of that mode; what is left over after the last pair of a list is
/// left out.
std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode);

/// Gives lines beside triangles in one mesh a mesh of their own, and each node of the mesh a child that has
/// it, with the node's skin, morph weights and instances, so that both are parts. Whether there were such
/// lines. Throws malformed.
bool part_lines(Json& document);

/// The lines beside triangles in each node's mesh where they stand in the world, named after the node, or
/// else the mesh. Materials are the document's. The document keeps them as they are. Throws malformed, and
/// limit beyond max_vertices points.
std::vector<Lines> decode_lines(Source& source, const std::vector<NodeFrame>& frames,
                                std::size_t max_vertices);

} // namespace facetmill::io::gltf
