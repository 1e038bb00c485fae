#pragma once
// Decides whether triangles that meet intersect or only touch.

#include "mesh/surface.hpp"
#include "mesh/topology.hpp"

#include <mutex>

namespace facetmill {

/// Judges pairs of triangles of a surface that meet elsewhere than in their shared corners. Such a pair
/// *touches* if all its common points are on the edges of both, and the surface does not pass through itself
/// at these points. If edges of both overlap, the triangles beyond them must not be on different sides. For
/// example, a solid with two coincident edges touches itself, but a solid whose walls pass through each
/// other exactly at their edges does not. If all pairs of a surface touch, the surface never passes through
/// itself. Proof: around a common point of edges, it would pass through itself along a direction that is
/// inside a triangle of some pair, or along edges of two triangles. If a triangle beyond an edge has no area
/// or is not finite, the pair does not touch. Decided exactly.
class TouchTest {
  public:
    explicit TouchTest(const Surface& surface) : surface_(surface) {}

    /// Requires that both triangles have area, meet, and share at most one vertex. Thread-safe.
    bool only_touch(Index s, Index t) const;

  private:
    struct Beyond {
        std::vector<Vec3> apexes; ///< third corners of the other triangles at the edge
        bool sound = true;
    };
    bool pass_through(Index s, Index t) const;
    Beyond beyond(Index triangle, Index corner) const;

    const Surface& surface_;
    mutable std::once_flag once_;
    mutable Mesh triangles_; ///< with its edges, computed when a pair needs them
    mutable EdgeTable edges_;
};

} // namespace facetmill
