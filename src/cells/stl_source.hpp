#pragma once
// Binary STL, face by face: places are what makes vertices.

#include "cells/face_source.hpp"

namespace facetmill::cells {

/// Why an STL file cannot be read face by face, in words; none when it can.
std::optional<std::string> why_stl_not_streamed(const io::Input& input);
/// As the header says. The file must be binary.
std::uint64_t stl_faces(const io::Input& input);
/// Throws as open_faces.
std::unique_ptr<FaceSource> open_stl(io::Input input, const io::ReadSettings& settings);

} // namespace facetmill::cells
