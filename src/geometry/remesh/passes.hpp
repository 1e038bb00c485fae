#pragma once
// The passes of an iteration of remeshing.

#include "geometry/remesh/anchor.hpp"

namespace facetmill::remeshing {

/// The least cosine of the angle by which a step may turn the normal of a face: 60 degrees.
inline constexpr double least_turn = 0.5;

/// Whether a face may get another normal. Faces without area have no normal, and may get any.
[[nodiscard]] inline bool may_turn(const Vec3& before, const Vec3& after) {
    const double square = dot(before, before) * dot(after, after), along = dot(before, after);
    if (!(dot(before, before) > 0)) return true;
    return along > 0 && along * along >= least_turn * least_turn * square;
}

/// Triangles of a worse shape have unreliable normals.
inline constexpr double sliver = 0.15;

/// The shape of a triangle: 1 for an equilateral one, 0 for one without area.
[[nodiscard]] double shape_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// Splits edges longer than 4/3 of the intended length at a point of the surface, the longest first.
void split_long_edges(WorkingMesh& mesh, const Anchor& anchor);

/// Collapses edges shorter than 4/5 of the intended length into one of their ends, the shortest first. Keeps
/// the topology and feature lines, and makes no edge that split_long_edges would split.
void collapse_short_edges(WorkingMesh& mesh, const Anchor& anchor);

/// Flips edges where this brings the number of edges nearer to 6 at each vertex, or to 4 at a border.
void flip_towards_six(WorkingMesh& mesh);

/// Flips edges where this makes the worse shape of two triangles better. Returns the number.
std::size_t flip_for_shape(WorkingMesh& mesh);

/// Moves vertices towards the middle of their faces, along the surface or along their feature line. All
/// vertices move at once. If a face would turn, its vertices do not move. Parallel.
void relocate(WorkingMesh& mesh, const Anchor& anchor);

} // namespace facetmill::remeshing
