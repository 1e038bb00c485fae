#pragma once
// Plane sections of a mesh: the contours that a plane, or a stack of parallel planes, cuts out of it.
// Each vertex is classified once by the exact sign of its side (mesh/plane.hpp). A vertex on the plane
// counts as above it, so the result is the section of a plane just below. Therefore a face in the plane
// contributes its outline if it is a top and nothing if it is a bottom. The sections of two halves of a
// solid never count the same area twice.

#include "geometry/polygon/polygon.hpp"
#include "mesh/cut_memory.hpp"
#include "mesh/mesh.hpp"
#include "mesh/plane.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace facetmill {

/// The coordinates of a plane in the world. The origin is the foot of the world's origin on the plane, so
/// that the sections of a stack line up; v is normal x u.
struct SectionFrame {
    Vec3 origin, u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

    Vec2 flat(const Vec3& p) const { return {dot(p - origin, u), dot(p - origin, v)}; }
    Vec3 point(const Vec2& p) const { return origin + u * p.x + v * p.y; }
    Vec3 direction(const Vec2& d) const { return u * d.x + v * d.y; }
};

/// The frame of a plane: u is the axis after the normal's longest component (x for z), made perpendicular to
/// the normal. For normals along an axis, plane coordinates are world coordinates.
[[nodiscard]] SectionFrame frame_of(const Plane& plane);

struct SectionSettings {
    Plane plane;                    ///< in world space
    std::vector<double> heights{0}; ///< ascending, in world units along the normal from the plane
    Transform to_world;             ///< from the mesh's space
    /// Points known to be on planes, in the mesh's space. Points on a plane of the stack count as on it.
    /// Null: no known points.
    const CutMemory* memory = nullptr;
};

/// The role of a contour within its section.
enum class ContourRole {
    outline, ///< encloses material; empty outside
    hole,    ///< empty inside; surrounded by material
    inner,   ///< material on both sides, because bodies overlap
    open,    ///< not closed, because the mesh has a boundary
};
[[nodiscard]] const char* to_string(ContourRole role);

struct Contour {
    Index begin = 0, end = 0; ///< range in Section::points
    ContourRole role = ContourRole::outline;
    Index parent = none; ///< the innermost contour around it, or none
    int orientation = 1; ///< viewed against the normal: 1 anticlockwise, -1 clockwise, 0 balanced
    polygon::Kind kind = polygon::Kind::convex;
    double area = 0;   ///< area of the region that it winds around (nonzero rule); negative if clockwise
    double length = 0; ///< length of the contour
    std::optional<polygon::Moments> moments; ///< moments of the region that it winds around; none if open
};

/// The section at a height.
struct Section {
    double height = 0;
    SectionFrame frame;
    std::vector<Vec2> points;      ///< in the frame, contour by contour
    std::vector<Contour> contours; ///< in the order of the faces at which they start
    /// The sum over closed contours: holes are subtracted, and overlaps count twice. Negative if the surface
    /// is inside out, like its volume.
    double area = 0;
    bool oriented = true; ///< neighbours agree; otherwise contours were oriented by nesting (even-odd)
    std::size_t collapsed =
        0; ///< contours that shrank to a point or line, because the plane only touches the surface
    polygon::Contact contact = polygon::Contact::none; ///< contact among all closed contours
    /// Moments of outlines and holes together; none if a contour is open, or overlaps itself or another.
    std::optional<polygon::Moments> moments;

    polygon::Ring ring(const Contour& c) const { return {points.data() + c.begin, points.data() + c.end}; }
    /// Outlines and holes to fill in a drawing, by the nonzero rule. So overlapping bodies form a single
    /// region, and everything that a self-crossing contour winds around is inside.
    std::vector<polygon::Ring> filled() const;
    /// The number of clockwise outlines, at which the surface is inside out.
    std::size_t inside_out() const;
};

/// Sections at all heights, in order; a plane that misses the mesh gives a section without contours.
/// Contours of consistently oriented closed meshes have the material on their left. Points are computed once
/// per cut edge, and a vertex exactly on a plane is used unchanged. Points that coincide or are straight up
/// to rounding (64 units in the last place of the section's largest coordinate) are dropped. Takes one pass
/// over the vertices and faces, plus n log n in the points of each section. Parallel; the result does not
/// depend on the number of threads. Throws a usage error (E-PLANE) for a bad plane and a limit error
/// (E-SECTION) beyond 2^31 segments.
[[nodiscard]] std::vector<Section> section(const Mesh& mesh, const SectionSettings& settings);

/// Computes roles, parents, kinds and measures of the contours of a section whose points are set.
void arrange(Section& section);

/// The range of distances from a plane along its normal, in world units. Empty if low > high.
struct Extent {
    double low = HUGE_VAL, high = -HUGE_VAL;
    void add(const Extent& other) {
        low = other.low < low ? other.low : low;
        high = other.high > high ? other.high : high;
    }
};

/// The extent of all vertices of a mesh. Parallel.
[[nodiscard]] Extent extent_along(const Plane& plane, const Mesh& mesh, const Transform& to_world);

struct Stack {
    std::vector<double> heights{0}; ///< ascending distances from the plane
    double spacing = 0;             ///< 0: a single plane
};

/// The planes of a stack. With spacing and count: this many planes, starting with the plane. With only
/// spacing (above zero): all multiples from the plane, in both directions, through the extent. With only
/// count: the middles of as many equal slices of the extent, so that areas times spacing is the midpoint
/// rule for the volume. Throws a limit error (E-SECTION) above 100,000 planes.
[[nodiscard]] Stack stack_of(const Extent& extent, std::optional<double> spacing,
                             std::optional<std::int64_t> count);

inline constexpr std::int64_t max_planes = 100000;

} // namespace facetmill
