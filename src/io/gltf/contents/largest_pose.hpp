#pragma once
// Animated scales: a node that grows from nothing is as large as its largest key.

#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"

namespace facetmill::io::gltf {

/// [nodes] the world transforms with the largest scale that any animation gives each node. Rotations and
/// translations are at rest.
[[nodiscard]] std::vector<Transform> largest_worlds(Source& source, const std::vector<NodeFrame>& frames);

} // namespace facetmill::io::gltf
