#pragma once
// The methods of split that choose edges: bisect, notch, halve, and their closures.

#include "geometry/split/split.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

/// The edges of a mesh, and their lengths in world space.
struct MeasuredEdges {
    EdgeTable table;
    std::vector<double> squared; ///< [edges] squared length, the same for all faces of the edge
};
[[nodiscard]] MeasuredEdges measure_edges(const Mesh& mesh, const Transform& to_world);

/// A byte per edge: 1 if faces are cut at the edge.
using EdgeMarks = std::vector<std::uint8_t>;

/// The local number (0 to 2) of the longest edge of each triangle; 3 without a longest edge. Ties use the
/// lower edge.
[[nodiscard]] std::vector<std::uint8_t> longest_edges(const Mesh& mesh, const MeasuredEdges& edges);

/// The number of triangles that have an angle below settings.min_angle; the mesh must have only triangles.
[[nodiscard]] std::size_t narrow_faces(const Mesh& mesh, const SplitSettings& settings);

/// One pass of bisect, notch or halve over every face, or over the narrow faces (settings.min_angle).
/// Returns an empty optional if min_angle finds no face. Adds attribute changes and counts of spots to
/// so_far.
[[nodiscard]] std::optional<Mesh> split_marked(const Mesh& mesh, const SplitSettings& settings,
                                               SplitResult& so_far);

/// Cuts at the marked edges by bisect's rule; the marks must be closed under it.
[[nodiscard]] Mesh cut_marked(const Mesh& mesh, const MeasuredEdges& edges, const EdgeMarks& marks,
                              const std::vector<std::uint8_t>& longest, SplitSettings::Cut cut,
                              const Transform& to_world, SplitResult& so_far);

/// bisect with targets: cuts edges longer than max_edge. With a budget of faces, the longest edges come
/// first.
[[nodiscard]] SplitResult refine(const Mesh& mesh, const SplitSettings& settings);

} // namespace facetmill
