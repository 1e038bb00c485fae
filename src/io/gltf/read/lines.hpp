#pragma once
// The lines of a glTF document.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"

namespace facetmill::io::gltf {

/// The two ends of each line of a primitive with this mode. An incomplete last pair of a list is ignored.
[[nodiscard]] std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode);

/// If a mesh has lines and triangles, moves the lines to a separate mesh. Each node of the mesh gets a child
/// with the lines, and with the node's skin, morph weights and instances. So both become parts. Returns true
/// if a mesh had such lines. Throws a malformed-input error.
bool part_lines(Json& document);

/// The lines of meshes that also have triangles, per node in world space, named after the node or else the
/// mesh. Materials are the document's. The document keeps the lines unchanged. Throws a malformed-input
/// error, and a limit error beyond max_vertices points.
[[nodiscard]] std::vector<Lines> decode_lines(Source& source, const std::vector<NodeFrame>& frames,
                                              std::size_t max_vertices);

} // namespace facetmill::io::gltf
