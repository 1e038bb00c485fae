#pragma once
// Binary PLY, face by face: vertices are looked up by their number in the file itself.

#include "cells/face_source.hpp"

namespace facetmill::cells {

/// Why a PLY file cannot be read face by face, in words; none when it can. Throws malformed for a bad header.
std::optional<std::string> why_ply_not_streamed(const io::Input& input);
/// As the header says.
std::uint64_t ply_faces(const io::Input& input);
/// Throws as open_faces.
std::unique_ptr<FaceSource> open_ply(io::Input input, const io::ReadSettings& settings);

} // namespace facetmill::cells
