#pragma once
// The help and manual texts of tile.

namespace facetmill::help::tile {

inline constexpr const char* about = R"(Cuts parts into the tiles of a grid; each tile becomes a part.)";

inline constexpr const char* details =
    R"(Along each axis, tile k reaches from origin + k * size to origin + (k + 1) * size, in world space.
Tiles are named after their part and cell, NAME.x0.y1, and have the face attributes tile_x, tile_y
and tile_z for the axes that are cut. Cells without faces give no part. The points of a cloud, a
part without faces, are put into the tiles, and have these attributes; one on a border is in the
tile that begins there. To work on each tile, use foreach: {part: "*"}.

Borders match exactly, because neighbouring tiles come from the same cut, as in clip with keep:
both; its rules for attributes, caps and faces in the plane apply here as well. With cap: true a
closed part gives closed tiles, whose volumes add up to its own.)";

} // namespace facetmill::help::tile
