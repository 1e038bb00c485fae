#pragma once
// Writes cells as a tileset of 3D Tiles. Each cell becomes a small pyramid (geometry/pyramid). The roots are
// joined two to four at a time and simplified, up to a single tile.
//
// Vertices at positions shared with outside tiles are held in a tile at every level. They are free once all
// of their tiles are joined. The tiles of every cut therefore fit together, as in a pyramid made in memory.

#include "cells/partition/partition.hpp"
#include "io/codec.hpp"

#include <functional>

namespace facetmill::cells {

/// A tileset whose tile files were already passed on.
struct WrittenTiles {
    std::vector<io::OutputFile> index; ///< the tileset, then the files that it names except tiles
    std::vector<std::string> names;    ///< names of the tile files, each tile before its descendants
    io::TilesWritten told;
    io::VertexCacheUse cache;
    AttributeChanges changes;
    std::vector<Diagnostic> warnings;
};

/// The minimum memory in bytes, with one worker, to make a tileset of a mesh of `faces` faces with tiles of
/// `tile` faces.
[[nodiscard]] std::uint64_t memory_for_tiles(std::uint64_t faces, std::uint64_t tile);

/// Passes each tile file to put once it is made, one at a time, in any order. transform: from cell space to a
/// z-up world in metres. The tiles have no materials, seams or textures. The tree depends only on the mesh
/// and the settings. Throws a limit error (E-MEMORY) if joined tiles exceed memory, a stage error (E-RANGE),
/// an output error (E-SCRATCH, E-SPACE), and the errors of put.
[[nodiscard]] WrittenTiles write_tiles(const Partition& partition, const Transform& transform,
                                       const io::WriteSettings& settings, const CellResources& means,
                                       const std::function<void(const io::OutputFile&)>& put);

} // namespace facetmill::cells
