#pragma once
// Surfaces seen along an axis, such as terrains: how they cover the plane, and the volume between two of
// them.

#include "geometry/cgal/triangulate_polygon.hpp"
#include "geometry/polygon/footprint.hpp"
#include "mesh/surface.hpp"

#include <cstdint>
#include <optional>

namespace facetmill {

/// A space whose z is the coordinate along an axis, and whose x and y are the footprint's plane (see
/// seen_along). The origin is subtracted. It is chosen so that differences are exact for all points of a box
/// that is far from 0 compared to its size.
struct TerrainView {
    std::size_t axis = 2; ///< 2 z, 1 y, 0 x
    Vec3 origin;          ///< in this space

    /// Along the axis, for points in the box, which is in world space.
    [[nodiscard]] static TerrainView of(std::size_t axis, const Box& world);
    Vec3 seen(const Vec3& p) const {
        return Vec3{axis == 0 ? p.y : p.x, axis == 2 ? p.y : p.z, p[axis]} - origin + Vec3{};
    }
    /// The world position of a point.
    Vec3 world(const Vec3& seen) const;
};

/// How a surface covers the plane. Faces that are edge-on do not count.
enum class Cover {
    once,      ///< no line along the axis meets it twice
    overhangs, ///< some lines meet it three times or more, but its faces are oriented, so each counts once
    solid,     ///< it is closed or like a closed surface: each line leaves it as often as it enters
    several    ///< sheets lie above each other, or an overhanging surface is not oriented
};

struct SeenSurface {
    std::vector<Vec3> points;   ///< as TerrainView::seen
    std::vector<Index> corners; ///< three per triangle
    /// [triangles] The sign with which the triangle counts. For `once`, 1; for `overhangs`, -1 if it looks
    /// the other way than the surface; for `solid`, 1 if it looks up. 0 for edge-on triangles and for corners
    /// that are not finite.
    std::vector<std::int8_t> sign;
    std::vector<std::int8_t> turn; ///< [triangles] 1 anticlockwise, -1 clockwise, 0 neither
    Cover cover = Cover::once;
    Contours outline; ///< the outline of the covered area, anticlockwise; none for `solid` and `several`
    std::optional<Vec2> doubled; ///< for `several`: a place that it covers twice
    double doubled_area = 0;     ///< covered more than once; at most a millionth, except for `several`

    std::size_t size() const { return sign.size(); }
};

/// The signs are exact for the surface after rounding by TerrainView::seen, and so is `cover`, except that up
/// to a millionth of the area may be covered twice. O(n log n).
[[nodiscard]] SeenSurface seen_surface(const Surface& surface, const TerrainView& view);

struct VolumeSettings {
    std::size_t axis = 2;
    double level = 0;                     ///< the height of the plane to compare with
    const Surface* other = nullptr;       ///< compares with this surface instead of the plane
    const Footprint* footprint = nullptr; ///< compares only inside; null: wherever there is a surface
};

/// Where the surface is on one side of the reference.
struct VolumeSide {
    double volume = 0, area = 0, deepest = 0; ///< the area is measured in the plane
    double mean() const { return area > 0 ? volume / area : 0; }
};

struct VolumeResult {
    Cover cover = Cover::once, other_cover = Cover::once;
    std::optional<Vec3> doubled, other_doubled; ///< see SeenSurface; in the world, on the plane through 0
    VolumeSide above, below;                    ///< for `solid`, the solid above and below the reference
    /// Areas in the plane. `compared` is where both are present; all are 0 for `solid`.
    double compared = 0, level = 0;                  ///< level: where both have the same height
    double doubled_area = 0, other_doubled_area = 0; ///< see SeenSurface
    double footprint = 0;                            ///< or the surface's area without a footprint
    double missing = 0, missing_in_other = 0;        ///< the parts of the footprint without a surface
};

/// The volume between a surface and a plane or another surface, seen along an axis. Both are piecewise
/// linear, so the sum over the overlay of their triangles and the triangles of the footprint is exact up to
/// the rounding of sums. The faces' orientation matters only where the surface overhangs. If one of them is
/// `several`, only cover and doubled are set; also if the surface is `solid` and compared with another
/// surface, or the other surface is `solid`. Parallel; the result does not depend on the number of threads.
[[nodiscard]] VolumeResult volume_between(const Surface& surface, const VolumeSettings& settings);

} // namespace facetmill
