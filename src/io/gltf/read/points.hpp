#pragma once
// The points of a glTF document.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"

namespace facetmill::io::gltf {

/// A part for each primitive of points, in world space, with its attributes, material and extras. Parts are
/// named after the node or else the mesh. The parts belong to no document. Throws a malformed-input error,
/// and a limit error beyond max_vertices points.
[[nodiscard]] std::vector<Part> decode_points(Source& source, const std::vector<NodeFrame>& frames,
                                              std::size_t max_vertices);

} // namespace facetmill::io::gltf
