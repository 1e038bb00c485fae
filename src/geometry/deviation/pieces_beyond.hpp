#pragma once
// Finds the few parts of a surface that may be farther from another surface than a distance.

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
    std::vector<Index> triangles;     ///< whole triangles
    std::vector<SurfacePiece> pieces; ///< parts of other triangles
};

/// Skips all parts certainly within `distance` > 0, by three tests: all corners are within the distance of a
/// single triangle of the other surface, which is convex; or the middle is nearer by at least its distance
/// to the corners; or all parts of a triangle pass these tests. Triangles are cut into up to 36 parts,
/// slivers in rows between their tip and the opposite edge. These parts are cut up to twice more, while no
/// more than about `most` remain. order: the triangles to test, with finite corners, each near the previous.
/// near: [vertices] a triangle of `to` within the distance of each vertex, or none; or empty. The result
/// does not depend on the number of threads.
[[nodiscard]] Beyond pieces_beyond(const Surface& from, std::span<const Index> order, const FaceTree& to,
                                   std::span<const Index> near, double distance, std::size_t most);

} // namespace facetmill
