#pragma once
// The lines of a scene, for measuring distances.

#include "geometry/deviation/deviation.hpp"
#include "mesh/scene.hpp"

#include <map>

namespace facetmill::report {

/// Lines as degenerate triangles, with their ends and midpoints.
struct LineShape {
    Surface lines, points;

    LineShape() = default;
    /// All lines of the scene.
    explicit LineShape(const Scene& scene);
    void add(const Vec3& a, const Vec3& b);
    /// The largest distance from an end or midpoint of a line to the nearest line of the other; 0 without
    /// lines.
    double distance_to(const LineShape& other) const;
};

/// The lines by material (none: without material). O(lines log materials).
[[nodiscard]] std::map<Index, LineShape> lines_by_material(const Scene& scene);

} // namespace facetmill::report
