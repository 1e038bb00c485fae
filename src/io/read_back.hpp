#pragma once
// Decodes a written file again and compares it with the scene, so that reports show measured values.

#include "base/json.hpp"
#include "geometry/inspect/inspect.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io {

/// Changes to the vertices that faces use.
struct VertexChanges {
    std::size_t rounded = 0; ///< distinct positions lost because rounding made points coincide
    std::size_t merged = 0;  ///< further vertices lost because the file merges vertices at the same position
    std::size_t added = 0;   ///< vertices added because the file splits vertices of the scene
};

/// Compares the counts of vertices and of distinct positions. If part counts are equal, compares part by
/// part in the parts' spaces. Otherwise compares the whole scenes in world space. O(n log n).
[[nodiscard]] VertexChanges vertex_changes(const Scene& before, const Scene& after);

struct ReadBack {
    Scene scene; ///< the decoded file
    std::size_t vertices = 0, faces = 0, lines = 0;
    double position_error = 0; ///< the largest displacement of a vertex that faces use, in the file's units
    double tolerance = 0;      ///< the largest displacement that the format and its settings allow
    double diagonal = 0;       ///< diagonal of the scene
    double float_step = 0;     ///< distance between neighbouring float32 numbers at the farthest coordinate
    double grid_step = 0;      ///< step of the coarsest grid of positions (Draco, quantize); 0 without a grid
    Properties soundness;      ///< properties of the decoded file
    std::vector<std::string> losses; ///< properties that the scene has and the file lost
    VertexChanges changes;           ///< the cause, if there are losses
    SecondReading second;            ///< without differences
    /// Whether float32 rounding, and not the grid, moved points by more than a millionth of the diagonal,
    /// because coordinates are far from the origin.
    bool too_far_for_floats() const;
    Json json() const; ///< Members: vertices, faces, lines if any, position_error, closed, edge_manifold ...
};

/// Decodes the file and compares it with the scene (in the file's convention). The number of faces (polygons
/// or their triangles) and of lines must match. Vertices used by faces, and ends of lines, must lie within
/// the tolerance of float32 or the grid of their counterparts, in both directions. Throws an output error
/// (E-READBACK) otherwise, and if a second reader (Codec::read_again) finds other contents. Changes to
/// closedness, manifoldness, orientation, and degenerate or duplicate faces are reported in `losses`, without
/// an error. written: the codec's result. Only faces that it counts as dropped may be missing.
[[nodiscard]] ReadBack read_back(const Input& file, const Codec& codec, const Scene& scene,
                                 const WriteSettings& settings, const Written& written = {});

} // namespace facetmill::io
