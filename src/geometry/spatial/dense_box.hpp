#pragma once
// Computes the box of most points. A single point far away would cost frames and curves over the box of all
// points their precision.

#include "base/math/vec.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace facetmill {

/// The box around the middle of the points, without far outliers. To each side it extends 32 times the extent
/// of the middle half of the points along its longest axis. It is clipped to `all`, the box of all points.
/// Returns `all` if no point is outside. Uses about a thousand points, evenly spaced by number. point_of(i)
/// returns point i.
template <class PointOf>
[[nodiscard]] Box dense_box(std::size_t count, const Box& all, PointOf&& point_of) {
    std::array<std::vector<double>, 3> at;
    for (std::size_t i = 0; i < count; i += count / 1024 + 1) {
        const Vec3 p = point_of(i);
        if (!is_finite(p)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) at[axis].push_back(p[axis]);
    }
    const std::size_t many = at[0].size();
    if (many < 16) return all;
    double reach = 0;
    for (auto& x : at) {
        std::sort(x.begin(), x.end());
        reach = std::max(reach, 32 * (x[many * 3 / 4] - x[many / 4]));
    }
    if (!(reach > 0)) return all;
    Box dense;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        dense.min[axis] = std::max(all.min[axis], at[axis][many / 2] - reach);
        dense.max[axis] = std::min(all.max[axis], at[axis][many / 2] + reach);
    }
    return dense;
}

} // namespace facetmill
