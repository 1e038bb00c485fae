#pragma once
// A mesh as a tree of tiles: the leaves have all its faces, and each tile above them has, in fewer, what the
// tiles below it have together. The one header of this folder that others include.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

struct PyramidSettings {
    /// A tile has at most so many triangles, but where the vertices that it shares with others need more, or
    /// its mesh cannot be simplified that far.
    std::size_t faces = 20000;
    /// The positions that come in are multiples of this, a power of two; those of all tiles are then. 0: any.
    double step = 0;
};

struct PyramidTile {
    Mesh mesh;
    /// How far the tile and the faces that it stands for are apart at most: the deviation from the tiles
    /// below it, measured both ways, plus the largest error of those; 0 for a leaf. In the mesh's units.
    double error = 0;
    std::vector<std::size_t> children; ///< four of most, two or three of others; none for a leaf
    std::string name;                  ///< the way from the root, a digit for each child: "" for the root
    /// [vertices] Their numbers in the mesh that came in; none: made above, and no other tile has them.
    std::vector<Index> numbers;
};

/// Cuts a mesh of triangles into whole faces, along the longest side again and again, as few leaves of up to
/// `faces` as there can be, and joins up to four tiles at a time and simplifies them, up to one tile: the
/// first of the result; each tile stands before its children.
///
/// Vertices at one place that tiles have in common are held until all tiles that have them are joined. So
/// whichever tiles are chosen such that each face that came in is represented once, their common borders are
/// the same vertices and edges on both sides, whatever the levels: tiles of a closed mesh close. The price:
/// along its border a tile is as fine as the mesh that came in, so its triangles are at least about as many
/// as the square root of those that it stands for, times six for compact tiles.
///
/// Where simplification is stuck at more than twice what a tile should have (many components), it may also
/// drop components and close holes, which counts in the error.
///
/// Attributes: as simplify has them; wedges that tiles have in common are one again above. Vertices that no
/// face uses are dropped. The same bytes for any number of threads. About O(n log n).
///
/// held: [vertices] those that what stands beside this mesh has, too, which stay in every tile; empty: none.
std::vector<PyramidTile> make_pyramid(const Mesh& mesh, const PyramidSettings& settings,
                                      const std::vector<std::uint8_t>& held = {});

/// A tile that stands for others.
struct CoarserTile {
    Mesh mesh;
    double error = 0;           ///< see PyramidTile
    std::vector<Index> sources; ///< [vertices] of the joined mesh
};

/// The tile above some that are joined to one mesh, the vertices made one that they have in common. held:
/// [vertices] of it, those that tiles outside have. error_below: the largest of the tiles'.
CoarserTile coarser_tile(const Mesh& joined, const std::vector<std::uint8_t>& held, double error_below,
                         const PyramidSettings& settings);

} // namespace facetmill
