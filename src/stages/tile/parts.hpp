#pragma once
// Cuts the parts of a scene into tiles.

#include "geometry/tile/tile.hpp"
#include "stage/context.hpp"

namespace facetmill {

struct ReportedTile {
    std::string part;
    std::array<std::optional<std::int64_t>, 3> cell{}; ///< by axis, of those that are cut
    std::size_t faces = 0;
};

struct TileReport {
    std::vector<ReportedTile> tiles;
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0;
};

/// The scene with each part selected replaced by its tiles, named after part and cell ("body.x0.y-1").
/// settings: the same for all; transform, memory and the caps' primitive are set part by part. Warns of open
/// contours (W-CAP-OPEN) and of parts without faces (W-TILE-NOTHING).
Scene tile_parts(Scene scene, const TileSettings& settings, const std::string& cap_material, Context& context,
                 TileReport& report);

} // namespace facetmill
