#pragma once
// Reads glTF as rows, see cells/sources/rows.hpp.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

bool is_gltf(const io::Input& input);
/// The reason for messages why a glTF cannot be read face by face; none if it can. Throws a malformed-input
/// error.
[[nodiscard]] std::optional<std::string> why_gltf_not_streamed(const io::Input& input);
/// The number of faces of all placed meshes.
[[nodiscard]] std::uint64_t gltf_faces(const io::Input& input);

} // namespace facetmill::cells
