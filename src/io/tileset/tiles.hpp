#pragma once
// The files of a tileset: each tile as a GLB, and the JSON that names them.

#include "io/tileset/frame.hpp"

#include <array>

namespace facetmill::io::tileset {

/// A tile in the tree: boxes are in the tileset's frame.
struct TreeTile {
    std::string name;                  ///< the way from the root, a digit for each child
    std::vector<std::size_t> children; ///< among the tiles
    double error = 0;
    Box own, all; ///< around its content; and around that of the tiles below it, too
    std::size_t faces = 0, dropped_faces = 0;
    VertexCacheUse cache;
};

/// The settings for a tile of a tileset with these: whole steps where there are grids, images that all tiles
/// share unless they are embedded or named.
WriteSettings settings_of_tiles(const WriteSettings& settings);

/// The path of a tile's file, relative to the tileset's. settings: settings_of_tiles.
std::string uri_of_tile(const WriteSettings& settings, const std::string& name);

/// The twelve numbers of a bounding volume: the centre and the half sides, which lie along the axes.
std::array<double, 12> numbers_of_box(const Box& box);

/// The tile as a GLB, the first of the files, and the images of materials beside it. mesh: in the frame.
/// settings: settings_of_tiles. outline: materials and documents of all tiles, and no parts. Sets what of
/// the tile depends on its mesh, `all` as if it were a leaf. Any thread.
Written encode_tile(Mesh mesh, TreeTile& tile, const Scene& outline, const WriteSettings& settings,
                    const TilesetFrame& frame);

/// A tileset, and what it came to. tiles: each before its children, the root first; `all` of those that have
/// children is set.
struct TilesetSummary {
    std::vector<OutputFile> files; ///< the tileset, then what it names beside tiles
    TilesWritten told;
    VertexCacheUse cache;
    std::size_t dropped_faces = 0;
};
TilesetSummary summary_of(std::vector<TreeTile>& tiles, const TilesetFrame& frame,
                          const WriteSettings& settings);

} // namespace facetmill::io::tileset
