#pragma once
// STL: positions define vertices. A binary file is read directly; text is converted to rows.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

bool is_text_stl(const io::Input& input);
/// Opens a binary file. Throws the errors of open_faces.
[[nodiscard]] std::unique_ptr<FaceSource> open_stl(FaceSource::File file, const io::ReadSettings& settings,
                                                   FaceSource::Contents contents);

} // namespace facetmill::cells
