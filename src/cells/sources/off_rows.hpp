#pragma once
// OFF as rows, see cells/sources/rows.hpp.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

/// The reason why an OFF file cannot be read face by face, for messages; none if it can. Throws malformed.
[[nodiscard]] std::optional<std::string> why_off_not_streamed(const io::Input& input);
/// The count in the header. The file must be text.
[[nodiscard]] std::uint64_t off_faces(const io::Input& input);

} // namespace facetmill::cells
