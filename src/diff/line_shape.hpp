#pragma once
// The lines of a scene, as distances are measured from and to them.

#include "geometry/deviation/deviation.hpp"
#include "mesh/scene.hpp"

#include <optional>

namespace facetmill::report {

/// Lines as triangles without area, and their ends and middles.
struct LineShape {
    Surface lines, points;

    /// All lines of the scene, or those of one material (none: those without).
    explicit LineShape(const Scene& scene, std::optional<Index> material = {});
    /// From the ends and the middle of each line to the nearest line of the other; 0 without a line.
    double distance_to(const LineShape& other) const;
};

} // namespace facetmill::report
