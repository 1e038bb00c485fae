#pragma once
// OFF (Geomview): vertices and polygons, text or binary, with the prefixes ST, C and N.

#include "io/codec.hpp"
#include "io/text.hpp"

namespace facetmill::io::off {

/// What the header's keyword says.
struct Kind {
    bool uvs = false, colours = false, normals = false, binary = false;
};

/// Reads the keyword, which may be missing, and the word BINARY behind it; then come the counts. Throws
/// malformed (E-OFF) for kinds that are not read.
Kind read_kind(Text& text);

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::off
