#pragma once
// The numbers that positions of a tileset have: multiples of one power of two, counted from a point near the
// middle, so that float32, and the grids of Draco and quantize, hold those of every tile exactly, and what
// two tiles have in common is the same in both.

#include "io/codec.hpp"

namespace facetmill::io {

struct TilesetFrame {
    Vec3 origin;       ///< in the world
    double step = 1;   ///< a power of two
    double finest = 1; ///< that the step may become, where vertices would come to lie on each other
};

/// For positions in the box, by the longest side that the bits of Draco or quantize divide. The step may
/// become finer, unless the bits were given, up to what float32 holds from the middle to the ends. Throws
/// stage (E-RANGE) for a box that float32 cannot hold.
TilesetFrame usual_frame(const Box& box, const WriteSettings& settings);

/// The frame's step, or the first finer one at which no more of these vertices lie on each other than at the
/// finest.
double distinct_step(const std::vector<Vec3>& positions, const TilesetFrame& frame);

/// The usual frame with the distinct step.
TilesetFrame tileset_frame(const std::vector<Vec3>& positions, const WriteSettings& settings);

/// The nearest numbers of the frame.
void put_into_frame(std::vector<Vec3>& positions, const TilesetFrame& frame);

/// A point near the centre of the box, of few digits, on the frame's steps.
Vec3 tile_origin(const Box& box, const TilesetFrame& frame);

} // namespace facetmill::io
