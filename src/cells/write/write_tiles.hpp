#pragma once
// Cells as a tileset of 3D Tiles: each cell as a small pyramid (geometry/pyramid), whose roots are joined two
// to four at a time and simplified, up to one tile.
//
// Vertices that a tile has in common with tiles outside of it, by their place, are held in it, at whatever
// level; they are free where all that have them are joined. So the tiles of every cut fit together, as those
// of a pyramid in memory do.

#include "cells/partition/partition.hpp"
#include "io/codec.hpp"

#include <functional>

namespace facetmill::cells {

/// A tileset whose files were handed over.
struct WrittenTiles {
    std::vector<io::OutputFile> index; ///< the tileset, then what it names beside tiles
    std::vector<std::string> names;    ///< of the tiles' files, each tile before those below it
    io::TilesWritten told;
    io::VertexCacheUse cache;
    AttributeChanges changes;
    std::vector<Diagnostic> warnings;
};

/// Bytes that a tileset of a mesh of so many faces takes at least, with one worker, when its tiles have
/// `tile` faces.
std::uint64_t memory_for_tiles(std::uint64_t faces, std::uint64_t tile);

/// Hands over the tiles' files as they are made, one at a time, in any order. transform: from the cells' own
/// space to a world in metres, z up. Materials, seams and textures are none. The tree depends on the mesh and
/// the settings alone. Throws limit (E-MEMORY) where what is joined needs more memory than there is; stage
/// (E-RANGE); output (E-SCRATCH, E-SPACE, and what put throws).
WrittenTiles write_tiles(const Partition& partition, const Transform& transform,
                         const io::WriteSettings& settings, const CellResources& means,
                         const std::function<void(const io::OutputFile&)>& put);

} // namespace facetmill::cells
