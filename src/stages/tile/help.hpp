#pragma once
// The help and manual texts of tile.

namespace facetmill::help::tile {

inline constexpr const char* about = R"(Cuts parts into the tiles of a grid. Each tile becomes a part.)";

inline constexpr const char* details =
    R"(Along each axis, tile k reaches from origin + k * size to origin + (k + 1) * size, in world space.
Tiles are named after their part and cell, such as NAME.x0.y1.
They have the face attributes tile_x, tile_y and tile_z for the axes that are cut.
Cells without faces give no part.
The points of a point cloud are divided into tiles in the same way and get the same attributes.
A point on a border belongs to the tile that begins at the border.
To process each tile, use foreach: {part: "*"}.

Borders match exactly because neighbouring tiles come from the same cut.
The rules of clip with keep: both apply to attributes, caps and faces in the plane.
With cap: true, a closed part gives closed tiles, whose volumes add up to its volume.)";

} // namespace facetmill::help::tile
