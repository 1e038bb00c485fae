#pragma once
// The lines of a scene, as distances are measured from and to them.

#include "geometry/deviation/deviation.hpp"
#include "mesh/scene.hpp"

#include <map>

namespace facetmill::report {

/// Lines as triangles without area, and their ends and middles.
struct LineShape {
    Surface lines, points;

    LineShape() = default;
    /// All lines of the scene.
    explicit LineShape(const Scene& scene);
    void add(const Vec3& a, const Vec3& b);
    /// From the ends and the middle of each line to the nearest line of the other; 0 without a line.
    double distance_to(const LineShape& other) const;
};

/// The lines of each material that has some (none: those without). O(lines log materials).
std::map<Index, LineShape> lines_by_material(const Scene& scene);

} // namespace facetmill::report
