#pragma once
// glTF as rows, see cells/sources/rows.hpp.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

bool is_gltf(const io::Input& input);
/// The reason why a glTF cannot be read face by face, for messages; none if it can. Throws malformed.
[[nodiscard]] std::optional<std::string> why_gltf_not_streamed(const io::Input& input);
/// The faces of all placed meshes.
[[nodiscard]] std::uint64_t gltf_faces(const io::Input& input);

} // namespace facetmill::cells
