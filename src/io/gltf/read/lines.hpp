#pragma once
// The lines of a glTF document.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"

namespace facetmill::io::gltf {

/// The two ends of each line of a primitive with this mode. An incomplete last pair of a list is ignored.
[[nodiscard]] std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode);

/// The lines in each node's mesh that also has triangles, in world space, named after the node, or else the
/// mesh. Materials are the document's. The document keeps the lines unchanged. Throws malformed, and limit
/// beyond max_vertices points.
[[nodiscard]] std::vector<Lines> decode_lines(Source& source, const std::vector<NodeFrame>& frames,
                                              std::size_t max_vertices);

} // namespace facetmill::io::gltf
