#pragma once
// The numbers that positions of a tileset have: multiples of one power of two, counted from a point near the
// middle, so that float32, and the grids of Draco and quantize, hold those of every tile exactly, and what
// two tiles have in common is the same in both.

#include "io/codec.hpp"

namespace facetmill::io {

struct TilesetFrame {
    Vec3 origin;     ///< in the world
    double step = 1; ///< a power of two
};

/// For the positions, by the longest side that the bits of Draco or quantize divide; finer, where vertices
/// would come to lie on each other and the bits were not given, up to what float32 holds from the middle to
/// the ends.
TilesetFrame tileset_frame(const std::vector<Vec3>& positions, const WriteSettings& settings);

/// The nearest numbers of the frame.
void put_into_frame(std::vector<Vec3>& positions, const TilesetFrame& frame);

/// A point near the centre of the box, of few digits, on the frame's steps.
Vec3 tile_origin(const Box& box, const TilesetFrame& frame);

} // namespace facetmill::io
