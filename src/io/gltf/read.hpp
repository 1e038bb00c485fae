#pragma once
// A glTF file as a Scene: its document, its materials, and one part per node with triangles.

#include "io/codec.hpp"

namespace facetmill::io::gltf {

/// Reads .gltf or .glb, by content. Unit: metres; up: +Y. Throws malformed, missing and limit with the place
/// in the document ("meshes[0].primitives[1].indices: ...") and the file's name.
Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// The names of the parts that read would give, from the document alone. Throws malformed as read.
std::vector<std::string> peek(const Input& input);

} // namespace facetmill::io::gltf
