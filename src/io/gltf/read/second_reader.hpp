#pragma once
// Reads a written file with tinygltf, which shares no code with the writer, and compares the two readings.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io::gltf {

/// Compares the contents that tinygltf and our reader find in the same file: the counts of nodes, meshes,
/// materials, textures, images, skins, animations, cameras and scenes; the type, length and bounds of each
/// accessor; the triangles, lines and the box of each part. tinygltf decodes Draco but not meshopt, and does
/// not apply sparse accessors. It copies the file, so it is not asked if memory is short. scene: our reading
/// of the file, with its document.
[[nodiscard]] SecondReading read_again(const Input& file, const Scene& scene);

} // namespace facetmill::io::gltf
