#pragma once
// Which parts move by themselves.

#include "mesh/scene.hpp"

namespace facetmill::io {

/// For each part, whether an animation of its document drives the node it stands at, or one above it. Such a
/// node has to keep its transform, which is that of one moment only. Morph weights do not count. Throws
/// malformed when the document's nodes or animations are.
std::vector<bool> animated_parts(const Scene& scene);

} // namespace facetmill::io
