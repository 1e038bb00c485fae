#pragma once
// The position grid of a tileset: multiples of a power of two, relative to a point near the middle. Float32
// and the grids of Draco and quantize store grid positions exactly. Tiles therefore have equal positions at
// shared vertices.

#include "io/codec.hpp"

namespace facetmill::io {

struct TilesetFrame {
    Vec3 origin;       ///< in world space
    double step = 1;   ///< a power of two
    double finest = 1; ///< the smallest step allowed to keep vertices apart
};

/// The frame for positions in the box. The bits of Draco or quantize divide its longest side. Unless the
/// bits were given, the step may become finer, up to float32 precision at the ends of the box. Throws a
/// stage error (E-RANGE) for a box beyond the range of float32.
[[nodiscard]] TilesetFrame usual_frame(const Box& box, const WriteSettings& settings);

/// The frame's step, or the first finer step that merges no more of these vertices than the finest step.
[[nodiscard]] double distinct_step(const std::vector<Vec3>& positions, const TilesetFrame& frame);

/// The usual frame with the distinct step.
[[nodiscard]] TilesetFrame tileset_frame(const std::vector<Vec3>& positions, const WriteSettings& settings);

/// W-GEOCENTRIC if the origin is neither near 0, as in a local frame, nor near the surface of the earth, as
/// in the geocentric frame (ECEF) for which viewers of the globe take the root's transform.
[[nodiscard]] std::optional<Diagnostic> warning_of_place(const TilesetFrame& frame);

/// Rounds positions to the frame's grid.
void put_into_frame(std::vector<Vec3>& positions, const TilesetFrame& frame);

/// A point near the centre of the box, with few digits, on the frame's grid.
[[nodiscard]] Vec3 tile_origin(const Box& box, const TilesetFrame& frame);

} // namespace facetmill::io
