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

With fit, each part has its own grid, which begins at its bounding box.
The grid has the fewest tiles that fit into the given box. All tiles are equally long.
Tiles are numbered layer by layer from bottom to top, such as NAME.04.x0.y1.z1.
A part that already fits is not cut.
Each tile fits into the box together with its pegs.

Pegs join each pair of neighbouring tiles.
They point in the positive direction of their axis, so you can assemble the tiles row by row,
then layer by layer.
Each peg and hole is at least `wall` away from the surface, from other borders and from other pegs.
W-TILE-PEGS lists the pairs of tiles without room for a peg.
With pegs, the tiles' volumes add up to the volume of the part plus pegs minus holes.
Pegs have 32 sides.
A hole encloses a circle whose radius is the radius of the peg plus clearance.

Borders match exactly because neighbouring tiles come from the same cut.
The rules of clip with keep: both apply to attributes, caps and faces in the plane.
With cap: true, a closed part gives closed tiles, whose volumes add up to its volume.)";

} // namespace facetmill::help::tile
