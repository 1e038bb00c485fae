#pragma once
// Intersections of segments and rays with a surface, and inside tests. After P. Bourke, "Determining whether
// a line segment intersects a 3 vertex facet" (1997) and "Determining if a point lies on the interior of a
// polygon" (1987). Exact signs (base/math/predicates.hpp) decide whether a line meets a triangle.

#include "geometry/spatial/face_tree.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace facetmill {

/// A segment (0 <= t <= 1) or ray (t >= 0) of the points from + t (to - from).
struct Line {
    Vec3 from, to;
    bool ray = false;
};

/// An intersection of a line and a face.
struct Hit {
    double t = 0;
    Vec3 point;
    Index face = none;
    Index triangle = none; ///< in the tree's order
    int way = 0;           ///< 1: the line leaves through the front of the face; -1: it enters
};

/// Returns -1 or 1 (see Hit::way) if the line through from and to passes through the triangle, otherwise 0.
/// A line through an edge or a vertex is treated as if moved sideways by an infinitesimal amount, always to
/// the same side. So a surface that is crossed is crossed once, and a surface that is only touched is
/// crossed twice or not at all. A line within the plane of the triangle does not pass through it. Exact.
[[nodiscard]] int passes(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c);

/// The hit with the smallest t. Equal hits give the lowest face. None if the line misses the surface. A
/// segment's end point on a face is a hit.
[[nodiscard]] std::optional<Hit> first_hit(const FaceTree& tree, const Line& line);
/// All hits, sorted by t, then by face.
[[nodiscard]] std::vector<Hit> all_hits(const FaceTree& tree, const Line& line);

/// Hits of many lines. The hits of line i are hits[offsets[i]] to hits[offsets[i + 1]].
struct HitLists {
    std::vector<std::size_t> offsets;
    std::vector<Hit> hits;
    std::span<const Hit> of(std::size_t line) const {
        return {hits.data() + offsets[line], hits.data() + offsets[line + 1]};
    }
};
/// Parallel; the result does not depend on the number of threads.
[[nodiscard]] HitLists hits_of(const FaceTree& tree, std::span<const Line> lines, bool all);

/// Calls hit(face, way) for every triangle that a ray from p along a coordinate axis passes through, forward
/// or backward, in no order. way: see Hit. A ray through an edge or a vertex is moved sideways as in
/// `passes`. p itself is not on the ray. Exact.
void visit_along_axis(const FaceTree& tree, const Vec3& p, std::size_t axis, bool forward,
                      const std::function<void(Index face, int way)>& hit);

/// The direction for a single triangle: 1 or -1 (see Hit::way), or 0 if the ray does not pass through it.
[[nodiscard]] int passes_along_axis(const Vec3& p, std::size_t axis, bool forward, const Vec3& a,
                                    const Vec3& b, const Vec3& c);

/// The winding number of the surface around p, which must not be on it: 1 inside a closed surface, 0
/// outside, 2 where two overlap, -1 inside an inside-out surface. Counts the crossings of a ray along an
/// axis; exact. Meaningless for open surfaces.
[[nodiscard]] int winding(const FaceTree& tree, const Vec3& p);

/// Derives the winding number at `to` from the winding number at `from`, by counting the crossings of the
/// segment between them. The result equals winding(tree, to), but is faster for near points. Neither point
/// may be on the surface. Exact.
[[nodiscard]] int winding_beside(const FaceTree& tree, const Vec3& from, int winding_there, const Vec3& to);

/// Whether p is exactly on a triangle, including its border.
bool lies_on(const FaceTree& tree, const Vec3& p);

/// The cases of P. Bourke, "Determining whether a line segment intersects a 3 vertex facet" (1997), for a
/// segment and a planar polygon.
enum class Meeting { hit, parallel, in_plane, outside_segment, outside_facet };
[[nodiscard]] const char* to_string(Meeting meeting);
struct SegmentFacet {
    Meeting meeting = Meeting::parallel;
    double t = 0; ///< where the line meets the plane, unless it is parallel or in the plane
    Vec3 point;
};
/// Signs are exact for the plane through the first three corners that are not collinear.
[[nodiscard]] SegmentFacet meet(const Line& line, std::span<const Vec3> facet);

} // namespace facetmill
