#pragma once
// Queries on a surface for points and lines: the work of the probe stage.

#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays.hpp"

namespace facetmill {

enum class Side { inside, outside, on, unknown };
[[nodiscard]] const char* to_string(Side side);

struct PointAnswer {
    Side side = Side::unknown; ///< unknown for open surfaces, unless the point is on the surface
    int winding = 0;           ///< winding number of the surface around the point; 0 on the surface
    Closest closest;
};

struct PointSettings {
    bool closed = true;   ///< whether the surface has an inside
    double tolerance = 0; ///< up to this distance a point is on the surface; 0: exactly on it
};

/// Parallel; the result does not depend on the number of threads. A point is inside if the winding number is
/// not zero.
[[nodiscard]] std::vector<PointAnswer> probe_points(const FaceTree& tree, std::span<const Vec3> points,
                                                    const PointSettings& settings = {});

/// For each line, the first hit on a face that does not touch its start. So rays can start from vertices of
/// the surface itself. Parallel; the result does not depend on the number of threads.
[[nodiscard]] HitLists hits_away(const FaceTree& tree, std::span<const Line> lines);

} // namespace facetmill
