#pragma once
// PLY: a binary file is read as rows directly; text is converted to rows.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

/// The reason for messages why a PLY file cannot be read face by face; none if it can. Throws a
/// malformed-input error for a bad header.
[[nodiscard]] std::optional<std::string> why_ply_not_streamed(const io::Input& input);
/// The face count in the header.
[[nodiscard]] std::uint64_t ply_faces(const io::Input& input);
bool is_text_ply(const io::Input& input);
/// Opens a binary file. Throws the errors of open_faces.
[[nodiscard]] std::unique_ptr<FaceSource> open_ply(FaceSource::File file, const io::ReadSettings& settings,
                                                   FaceSource::Contents contents);

} // namespace facetmill::cells
