#pragma once
// OFF (Geomview): vertices and polygons, text or binary, with the prefixes ST, C and N.

#include "io/codec.hpp"

namespace facetmill::io::off {

/// What the header's keyword says.
struct Kind {
    bool uvs = false, colours = false, normals = false, binary = false;
};

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::off
