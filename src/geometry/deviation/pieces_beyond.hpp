#pragma once
// Finds the parts of a surface that may be farther from another than a distance that holds for most.

#include "geometry/spatial/face_tree.hpp"

#include <array>
#include <span>

namespace facetmill {

/// A part of a triangle of a surface.
struct SurfacePiece {
    std::array<Vec3, 3> corners;
    Index triangle;
};

struct Beyond {
    std::vector<Index> triangles;     ///< whole ones
    std::vector<SurfacePiece> pieces; ///< parts of others
};

/// Skips all parts certainly within `distance` > 0, by three tests. All corners are that near to one
/// triangle of the other surface, a convex set. The middle is nearer by at least its distance to the
/// corners. Or all parts of a triangle pass these tests. Triangles are cut into up to 36 parts, slivers in
/// rows between their tip and the opposite edge. These parts are cut twice more, as long as no more than
/// about `most` remain. order: the triangles to test, with finite corners, each near the previous. near:
/// [vertices] a triangle of `to` within the distance of each vertex, or none; or empty. The result is the
/// same for any number of threads.
[[nodiscard]] Beyond pieces_beyond(const Surface& from, std::span<const Index> order, const FaceTree& to,
                                   std::span<const Index> near, double distance, std::size_t most);

} // namespace facetmill
