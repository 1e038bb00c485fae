#pragma once
// OFF as rows, see cells/sources/rows.hpp.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

/// Why an OFF file cannot be read face by face, in words; none when it can. Throws malformed.
std::optional<std::string> why_off_not_streamed(const io::Input& input);
/// As the header says. The file must be text.
std::uint64_t off_faces(const io::Input& input);

} // namespace facetmill::cells
