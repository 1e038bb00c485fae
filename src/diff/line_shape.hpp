#pragma once
// The lines of a scene, for distance measurements.

#include "geometry/deviation/deviation.hpp"
#include "mesh/scene.hpp"

#include <map>

namespace facetmill::report {

/// Lines as degenerate triangles, and their ends and midpoints.
struct LineShape {
    Surface lines, points;

    LineShape() = default;
    /// All lines of the scene.
    explicit LineShape(const Scene& scene);
    void add(const Vec3& a, const Vec3& b);
    /// The largest distance from the ends and midpoint of each line to the other's lines; 0 without lines.
    double distance_to(const LineShape& other) const;
};

/// The lines by material (none: lines without a material). O(lines log materials).
std::map<Index, LineShape> lines_by_material(const Scene& scene);

} // namespace facetmill::report
