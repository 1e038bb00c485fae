#pragma once
// The report of hull.

#include "stages/hull/options.hpp"

#include <array>

namespace facetmill::hull_stage {

/// A convex shape, in world space.
struct HullShapeReport {
    std::string part, name;
    std::size_t vertices = 0, faces = 0, hull_vertices = 0;
    double volume = 0, hull_volume = 0;
    std::optional<Vec3> centre, size;
    std::optional<std::array<Vec3, 3>> axes;
    std::optional<std::array<Vec3, 2>> ends;
    std::optional<double> radius, concavity, resolution;
};

struct HullReport {
    std::vector<HullShapeReport> shapes;
};

void declare_hull_report(DeclareFields<HullReport>& d);

/// The numbers of a shape whose mesh the transform places in the world.
[[nodiscard]] HullShapeReport report_of(const HullResult& hull, const Transform& to_world);

} // namespace facetmill::hull_stage
