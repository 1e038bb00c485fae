#pragma once
// Cuts a mesh into the cells of a grid.

#include "geometry/clip/clip.hpp"

#include <array>

namespace facetmill {

/// The grid's planes perpendicular to an axis of the world, at origin + k * size for every integer k. With a
/// count, only for 0 < k < count: the first and the last cell have no outer border.
struct TileAxis {
    std::size_t axis = 0; ///< 0 x, 1 y, 2 z
    double size = 1;      ///< above zero
    double origin = 0;
    std::int64_t count = 0; ///< the number of cells; 0: unlimited
};

struct TileSettings {
    std::vector<TileAxis> axes; ///< each axis at most once
    Transform to_world;
    ClipSettings clip; ///< cap, cap_primitive, cap_numbers, snap and memory apply; tile sets the others
    std::size_t limit = 100000; ///< maximum number of tiles
};

/// The contents of a cell: coordinates from k * size up to (k + 1) * size.
struct Tile {
    std::array<std::int64_t, 3> cell{}; ///< k for each axis; 0 for axes that are not cut
    Mesh mesh;
};

struct TileResult {
    std::vector<Tile> tiles; ///< the nonempty tiles, sorted by z, then y, then x of their cells
    AttributeChanges changes;
    std::size_t cut_faces = 0, cap_faces = 0;
    std::vector<OpenContour> open;
    CutMemory memory;
};

/// Cuts the mesh in two recursively until every piece is in a single cell. So time grows with the logarithm
/// of the number of cells. Neighbours result from the same cut, so their borders have the same points.
/// Facing caps have the same triangles, except points that a later cap adds where contours cross. Faces in a
/// plane of the grid go to the side that they bound, as with Keep::both. Every tile has face attributes (for
/// a cloud: wedge attributes) tile_x, tile_y, tile_z (int32) for the axes that are cut. Throws a usage error
/// (E-TILE) for a size that is not above zero and a limit error (E-TILE) for too many tiles.
[[nodiscard]] TileResult tile(Mesh mesh, const TileSettings& settings);

} // namespace facetmill
