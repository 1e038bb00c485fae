#pragma once
// Which parts of a surface may be farther from another than a distance that most are within.

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

/// Leaves out what lies within `distance` > 0 for certain: what has all its corners that near to one triangle
/// of the other surface, a convex set; what has its middle nearer by as much as its corners are from there;
/// and what is a small part of a triangle whose parts do. Triangles are cut into up to 36 parts, slivers in
/// rows between their tip and the edge across from it, and those parts twice again, as long as no more than
/// about `most` are left. order: the triangles that are asked about, with finite corners, each near the one
/// before. near: [vertices] a triangle of `to` that each is within the distance of, or none, or empty. The
/// same for any number of threads.
Beyond pieces_beyond(const Surface& from, std::span<const Index> order, const FaceTree& to,
                     std::span<const Index> near, double distance, std::size_t most);

} // namespace facetmill
