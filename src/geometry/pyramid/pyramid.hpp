#pragma once
// A mesh as a tree of tiles: the leaves have all its faces, and each tile above them is a coarser version of
// the tiles below it. Other folders include only this header of the folder.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

struct PyramidSettings {
    /// The maximum number of triangles in a tile, unless its shared vertices need more, or its mesh cannot
    /// be simplified that far.
    std::size_t faces = 20000;
    /// The input positions are multiples of this, a power of two, and so are the positions of all tiles. 0:
    /// any.
    double step = 0;
};

struct PyramidTile {
    Mesh mesh;
    /// The largest distance between the tile and the faces that it represents. This is the deviation from
    /// the tiles below it, in both directions, plus the largest error of these tiles; 0 for a leaf. In the
    /// mesh's units.
    double error = 0;
    std::vector<std::size_t>
        children;     ///< most tiles have four children, others two or three; a leaf has none
    std::string name; ///< the path from the root, a digit for each child; "" for the root
    /// [vertices] Numbers in the input mesh. none: new in a coarser tile, and in no other tile.
    std::vector<Index> numbers;
};

/// Cuts a mesh of triangles into whole faces, repeatedly along the longest side, with as few leaves of up to
/// `faces` as possible. Then joins up to four tiles at a time and simplifies them, until a single tile is
/// left: the first of the result. Each tile comes before its children.
///
/// Coincident vertices of several tiles are held until all these tiles are joined. If a choice of tiles
/// represents each input face once, common borders have the same vertices and edges on both sides, at all
/// levels. So tiles of a closed mesh form a closed mesh. The price is that a tile's border is as fine as the
/// input mesh. A compact tile thus has at least about six times the square root of the number of triangles
/// that it represents.
///
/// If simplification stops at more than twice the limit of a tile (many components), it may also drop
/// components and close holes, which counts in the error.
///
/// Attributes follow the rules of simplify. Common wedges of tiles are merged in coarser tiles. Vertices
/// that no face uses are dropped. The result does not depend on the number of threads. About O(n log n).
///
/// held: [vertices] 1 for vertices shared with neighbouring meshes, which stay in every tile; empty: none.
[[nodiscard]] std::vector<PyramidTile> make_pyramid(const Mesh& mesh, const PyramidSettings& settings,
                                                    const std::vector<std::uint8_t>& held = {});

/// A tile that represents finer tiles.
struct CoarserTile {
    Mesh mesh;
    double error = 0;           ///< see PyramidTile
    std::vector<Index> sources; ///< [vertices] source vertices in the joined mesh
};

/// The coarser tile for finer tiles that are joined to a single mesh, with their common vertices merged.
/// held: [vertices] of the joined mesh, 1 for vertices shared with other tiles. error_below: the largest
/// error of the finer tiles.
[[nodiscard]] CoarserTile coarser_tile(const Mesh& joined, const std::vector<std::uint8_t>& held,
                                       double error_below, const PyramidSettings& settings);

} // namespace facetmill
