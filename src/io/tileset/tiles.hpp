#pragma once
// The files of a tileset: each tile as a GLB, and the JSON that names them.

#include "io/tileset/frame.hpp"

#include <array>

namespace facetmill::io::tileset {

/// A tile in the tree. Its boxes are in the tileset's frame.
struct TreeTile {
    std::string name;                  ///< the path from the root, a digit for each child
    std::vector<std::size_t> children; ///< indices of tiles
    double error = 0;
    Box own, all; ///< box of the content, and box including descendants
    std::size_t faces = 0, dropped_faces = 0;
    VertexCacheUse cache;
};

/// The settings for tiles of a tileset with these settings. They use integer positions on a grid, and share
/// images unless these are embedded or referenced.
[[nodiscard]] WriteSettings settings_of_tiles(const WriteSettings& settings);

/// The path of a tile's file, relative to the tileset's. settings: settings_of_tiles.
[[nodiscard]] std::string uri_of_tile(const WriteSettings& settings, const std::string& name);

/// The twelve numbers of a bounding volume: the centre and the half sides along the axes.
[[nodiscard]] std::array<double, 12> numbers_of_box(const Box& box);

/// The tile as a GLB (the first file), and the images of its materials. mesh: in the tileset's frame.
/// settings: settings_of_tiles. outline: a scene with the materials and documents of all tiles, without
/// parts. Sets the tile's fields that depend on its mesh, and `all` as for a leaf. Safe on any thread.
[[nodiscard]] Written encode_tile(Mesh mesh, TreeTile& tile, const Scene& outline,
                                  const WriteSettings& settings, const TilesetFrame& frame);

/// A written tileset and its statistics. tiles: each tile precedes its children, and the root is first.
/// Tiles with children must have `all` set.
struct TilesetSummary {
    std::vector<OutputFile> files; ///< the tileset, then the other files that it names except tiles
    TilesWritten told;
    VertexCacheUse cache;
    std::size_t dropped_faces = 0;
};
[[nodiscard]] TilesetSummary summary_of(std::vector<TreeTile>& tiles, const TilesetFrame& frame,
                                        const WriteSettings& settings);

} // namespace facetmill::io::tileset
