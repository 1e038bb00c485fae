#pragma once
// Cuts the parts of a scene into tiles.

#include "geometry/tile/tile.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// The scene with each part selected replaced by its tiles, named after part and cell ("body.x0.y-1").
/// settings: the same for all; transform, memory and the caps' primitive are set part by part. What was made
/// goes into the stage's result. Warns of open contours (W-CAP-OPEN) and of parts without faces
/// (W-TILE-NOTHING).
Scene tile_parts(Scene scene, const TileSettings& settings, const std::string& cap_material,
                 Context& context);

} // namespace facetmill
