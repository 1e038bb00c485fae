#pragma once
// COLOR_0 of a scene is linear, as in glTF. PLY, OFF, OBJ, STL, 3MF and Draco files hold sRGB colours, so
// their codecs convert when they read and write.

#include "io/codec.hpp"

namespace facetmill::io {

/// The reader of a codec, with the sRGB colours of the file made linear. Bytes become uint16, because 8 bits
/// of linear light cannot hold all dark tones. 16 bits become float32 for the same reason.
[[nodiscard]] decltype(Codec::read) with_linear_colours(decltype(Codec::read) read);

/// The writer of a codec, for scenes whose linear colours become sRGB: integers become bytes, which gives all
/// bytes that were read. Floats stay floats.
[[nodiscard]] decltype(Codec::write) with_srgb_colours(decltype(Codec::write) write);

/// Makes the colours of a scene that a writer of with_srgb_colours got linear again, for pictures.
void make_colours_linear(Scene& scene);

} // namespace facetmill::io
