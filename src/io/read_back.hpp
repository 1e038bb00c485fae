#pragma once
// What is claimed is measured: a written file is decoded again and compared with what it was to hold.

#include "base/json.hpp"
#include "geometry/inspect/inspect.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io {

/// What became of the vertices that faces use.
struct VertexChanges {
    std::size_t rounded = 0; ///< places fewer: rounding put points on others
    std::size_t merged = 0;  ///< vertices fewer beyond that: those at the same place are one in the file
    std::size_t added = 0;   ///< vertices more: the file has several where the scene has one
};

/// Compares by counts of vertices and of different places: part by part when both have as many parts, in the
/// parts' spaces, else in all, in world space. O(n log n).
VertexChanges vertex_changes(const Scene& before, const Scene& after);

struct ReadBack {
    Scene scene; ///< the file as decoded
    std::size_t vertices = 0, faces = 0, lines = 0;
    double position_error = 0;       ///< how far a vertex that faces use moved at most, in the file's units
    double tolerance = 0;            ///< how far the format and its settings may move one
    double diagonal = 0;             ///< of the scene
    double float_step = 0;           ///< between neighbouring float32 numbers at the farthest coordinate
    double grid_step = 0;            ///< of the coarsest grid of positions (Draco, quantize); 0 without
    Properties soundness;            ///< of the file as decoded
    std::vector<std::string> losses; ///< how it is less sound than the scene
    VertexChanges changes;           ///< why, when it is
    /// Whether coordinates are so far from the origin that float32 moved points by more than a millionth of
    /// the diagonal, and not the grid.
    bool too_far_for_floats() const;
    Json json() const; ///< vertices, faces, lines where there are some, position_error, closed,
                       ///< edge_manifold, vertex_manifold, ...
};

/// Decodes the file and compares it with the scene (in the file's convention): the number of faces (polygons,
/// or the triangles that they are cut into) and of lines, and the distance from every vertex that faces use
/// to the nearest one of the other side, and so of the ends of lines, within what float32 or the grid's bits
/// allow. Throws output (E-READBACK) when it does not hold what was written. What such rounding, or what the
/// format cannot hold, did to closedness, manifoldness, orientation and degenerate or duplicate faces is
/// told, not judged. written: what the codec said of the file, without which no face may be left out.
ReadBack read_back(const Input& file, const Codec& codec, const Scene& scene, const WriteSettings& settings,
                   const Written& written = {});

} // namespace facetmill::io
