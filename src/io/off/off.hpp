#pragma once
// OFF (Geomview): vertices and polygons, text or binary, with the prefixes ST, C and N.

#include "io/codec.hpp"
#include "io/text.hpp"

namespace facetmill::io::off {

/// The flags of the header's keyword.
struct Kind {
    bool uvs = false, colours = false, normals = false, binary = false;
};

/// Reads up to the counts: the optional keyword, and the word BINARY if it follows. Throws a malformed-input
/// error (E-OFF) for unsupported kinds.
Kind read_kind(Text& text);

[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::off
