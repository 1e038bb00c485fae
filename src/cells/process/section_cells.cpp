#include "cells/process/section_cells.hpp"

#include "cells/partition/gather.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::cells {

namespace {

double largest_of(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// An upper bound of all terms in the transform of a point in the box.
double largest_term(const Box& box, const Transform& transform) {
    double most = 0;
    for (const auto& row : transform.m) {
        double sum = std::abs(row[3]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum += std::abs(row[axis]) * std::max(std::abs(box.min[axis]), std::abs(box.max[axis]));
        most = std::max(most, sum);
    }
    return most;
}

} // namespace

Extent extent_of_cells(const Partition& partition, const Plane& plane, const Transform& to_world) {
    Extent extent;
    for (std::uint32_t leaf = 0; leaf < partition.tree().leaves.size(); ++leaf)
        extent.add(extent_along(plane, partition.cell(leaf).mesh, to_world));
    return extent;
}

Mesh faces_at_planes(const Partition& partition, const SectionSettings& settings,
                     const CellResources& means) {
    if (settings.heights.empty()) return {};
    Plane plane = settings.plane;
    plane.normal = plane.normal / length(plane.normal);
    plane.offset /= length(settings.plane.normal);
    const auto height = [&](const Vec3& p) { return side(plane, settings.to_world.point(p)); };
    // Exact predicates decide later which faces are cut. This selects more faces than rounding could affect.
    constexpr double near = 1e-9;
    const double margin = near * (largest_term(partition.source().contents().bounds, settings.to_world) +
                                  largest_of(plane.through) + std::abs(plane.offset) +
                                  std::abs(settings.heights.front()) + std::abs(settings.heights.back()));
    const std::vector<double>& heights = settings.heights;
    return gathered(
        *partition.shared_source(),
        [&](const Vec3& a, const Vec3& b, const Vec3& c) {
            const auto [low, high] = std::minmax({height(a), height(b), height(c)});
            return static_cast<std::size_t>(std::upper_bound(heights.begin(), heights.end(), high + margin) -
                                            std::lower_bound(heights.begin(), heights.end(), low - margin));
        },
        means);
}

} // namespace facetmill::cells
