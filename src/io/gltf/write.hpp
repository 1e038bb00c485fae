#pragma once
// A Scene as a glTF file: the document that it came from, patched, or a new one.

#include "io/codec.hpp"

namespace facetmill::io::gltf {

/// Writes .glb (binary) or .gltf with a .bin and the images beside it. The first document of the scene is
/// patched: its meshes, accessors, buffer views and buffers change as far as the parts have changed,
/// everything else stays. Parts of other documents are added with their materials and textures; what else
/// those documents had is dropped with a warning (W-MERGED). Throws stage and limit.
Written write(const Scene& scene, const WriteSettings& settings, bool binary);

} // namespace facetmill::io::gltf
