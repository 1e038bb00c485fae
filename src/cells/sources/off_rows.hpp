#pragma once
// Reads OFF as rows, see cells/sources/rows.hpp.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

/// The reason for messages why an OFF file cannot be read face by face; none if it can. Throws a
/// malformed-input error.
[[nodiscard]] std::optional<std::string> why_off_not_streamed(const io::Input& input);
/// The face count in the header. The file must be text.
[[nodiscard]] std::uint64_t off_faces(const io::Input& input);

} // namespace facetmill::cells
