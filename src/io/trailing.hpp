#pragma once
// Bytes after the contents of a file.

#include "io/codec.hpp"

namespace facetmill::io {

/// Warns (W-TRAILING) of bytes after the last item that a file promises. after: "the last of 12 triangles".
void warn_of_trailing(ReadLog& log, const std::string& file, std::size_t bytes, const std::string& after);

} // namespace facetmill::io
