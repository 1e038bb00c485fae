#pragma once
// Triangles that meet: whether they run into each other, or only touch.

#include "mesh/surface.hpp"
#include "mesh/topology.hpp"

#include <mutex>

namespace facetmill {

/// Judges pairs of triangles of a surface that meet elsewhere than in the corners that they share. Such a
/// pair *touches* when all points that it has in common lie on the edges of both, and the surface does not
/// pass through itself there: where edges of both run along each other, the triangles beyond them must not
/// lie on different sides. So a solid of which two edges lie on each other touches itself, and one whose
/// walls pass through each other exactly at their edges does not. A surface all of whose pairs touch never
/// passes through itself: around a common point of edges it would do so along a direction, which lies inside
/// a triangle of some pair, or along edges of two. Where a triangle beyond an edge has no area or is not
/// finite, the pair does not touch. Decided exactly.
class TouchTest {
  public:
    explicit TouchTest(const Surface& surface) : surface_(surface) {}

    /// Of two triangles with area that meet and share at most one vertex. From any thread.
    bool only_touch(Index s, Index t) const;

  private:
    struct Beyond {
        std::vector<Vec3> apexes; ///< of the other triangles at the edge
        bool sound = true;
    };
    bool pass_through(Index s, Index t) const;
    Beyond beyond(Index triangle, Index corner) const;

    const Surface& surface_;
    mutable std::once_flag once_;
    mutable Mesh triangles_; ///< and its edges: when a pair needs them
    mutable EdgeTable edges_;
};

} // namespace facetmill
