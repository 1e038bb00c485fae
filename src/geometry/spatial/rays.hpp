#pragma once
// Where segments and rays meet a surface, and what is inside it. After P. Bourke, "Determining whether a line
// segment intersects a 3 vertex facet" (1997) and "Determining if a point lies on the interior of a polygon"
// (1987); whether a line meets a triangle is decided by exact signs (base/math/predicates.hpp).

#include "geometry/spatial/face_tree.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace facetmill {

/// The points from + t (to - from): of a segment 0 <= t <= 1, of a ray t >= 0.
struct Line {
    Vec3 from, to;
    bool ray = false;
};

/// Where a line meets a face.
struct Hit {
    double t = 0;
    Vec3 point;
    Index face = none;
    Index triangle = none; ///< in the tree's order
    int way = 0;           ///< 1: the line leaves through the front of the face; -1: it enters
};

/// -1 or 1 (see Hit::way) when the line through from and to passes through the triangle, 0 when it does not.
/// A line through an edge or a vertex is taken as the line beside it, moved aside by less than any distance
/// and always to the same side: of the faces around an edge it passes through as many as it would there, so a
/// surface that is crossed is crossed once and one that is only touched twice or not at all. A line within
/// the plane of the triangle does not pass through it. Exact.
int passes(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c);

/// The hit with least t, of equal ones that of the lowest face; none when the line meets nothing. An end of a
/// segment that lies on a face meets it.
std::optional<Hit> first_hit(const FaceTree& tree, const Line& line);
/// All hits, by t, then by face.
std::vector<Hit> all_hits(const FaceTree& tree, const Line& line);

/// Hits of many lines: those of line i are hits[offsets[i]] to hits[offsets[i + 1]].
struct HitLists {
    std::vector<std::size_t> offsets;
    std::vector<Hit> hits;
    std::span<const Hit> of(std::size_t line) const {
        return {hits.data() + offsets[line], hits.data() + offsets[line + 1]};
    }
};
/// In parallel; the same for any number of threads.
HitLists hits_of(const FaceTree& tree, std::span<const Line> lines, bool all);

/// The faces that a ray from p along a coordinate axis passes through, forward or back: hit(face, way) for
/// every triangle, in no order, with way as in Hit. A ray through an edge or a vertex is taken as one beside
/// it, as in `passes`; p itself is not on the ray. Exact.
void visit_along_axis(const FaceTree& tree, const Vec3& p, std::size_t axis, bool forward,
                      const std::function<void(Index face, int way)>& hit);

/// Of one triangle, as above: 1, -1, or 0 where the ray does not pass through it.
int passes_along_axis(const Vec3& p, std::size_t axis, bool forward, const Vec3& a, const Vec3& b,
                      const Vec3& c);

/// How often the surface winds around p, which must not lie on it: 1 inside a closed surface, 0 outside, 2
/// where two overlap, -1 inside one that is inside out. By the crossings of a ray along an axis, exact.
/// Without a meaning for open surfaces.
int winding(const FaceTree& tree, const Vec3& p);

/// The winding number at `to` from that at `from`, by what the segment between them crosses: the same number
/// as winding(tree, to), faster when they are near each other. Neither may lie on the surface. Exact.
int winding_beside(const FaceTree& tree, const Vec3& from, int winding_there, const Vec3& to);

/// Whether p lies exactly on a triangle, borders included.
bool lies_on(const FaceTree& tree, const Vec3& p);

/// The cases of P. Bourke, "Determining whether a line segment intersects a 3 vertex facet" (1997), for one
/// segment and one planar polygon.
enum class Meeting { hit, parallel, in_plane, outside_segment, outside_facet };
const char* to_string(Meeting meeting);
struct SegmentFacet {
    Meeting meeting = Meeting::parallel;
    double t = 0; ///< where the line meets the plane, unless parallel or in it
    Vec3 point;
};
/// Signs are exact for the plane through the first three corners that are not on one line.
SegmentFacet meet(const Line& line, std::span<const Vec3> facet);

} // namespace facetmill
