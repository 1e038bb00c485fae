#include "geometry/wrap/touched_cells.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace facetmill {

namespace {

constexpr double slack = 1e-6; // in cells: rounding of points never hides a cell that the surface touches

std::int32_t floored(double x, std::int32_t count) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x), 0.0, count - 1.0));
}

/// The part of a convex polygon with low <= x[axis] <= high.
std::vector<Vec3> slab_of(const std::vector<Vec3>& polygon, std::size_t axis, double low, double high) {
    std::vector<Vec3> now = polygon, next;
    for (const double sign : {1.0, -1.0}) {
        const double limit = sign > 0 ? high : -low;
        next.clear();
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Vec3 &a = now[i], &b = now[(i + 1) % now.size()];
            const double da = sign * a[axis] - limit, db = sign * b[axis] - limit;
            if (da <= 0) next.push_back(a);
            if ((da < 0 && db > 0) || (da > 0 && db < 0)) next.push_back(mix(a, b, da / (da - db)));
        }
        now.swap(next);
    }
    return now;
}

std::array<std::int32_t, 2> range_of(const std::vector<Vec3>& polygon, std::size_t axis, std::int32_t count) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3& p : polygon) {
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
    }
    return {floored(low - slack, count), floored(high + slack, count)};
}

using CellCounts = std::array<std::int32_t, 3>;

/// Marks the cells of a triangle, given in cells, slab by slab and bar by bar.
void mark_cells(const std::vector<Vec3>& triangle, const CellCounts& cells,
                std::vector<std::uint8_t>& marks) {
    const auto [z0, z1] = range_of(triangle, 2, cells[2]);
    for (std::int32_t z = z0; z <= z1; ++z) {
        const auto slab = z0 == z1 ? triangle : slab_of(triangle, 2, z - slack, z + 1 + slack);
        if (slab.empty()) continue;
        const auto [y0, y1] = range_of(slab, 1, cells[1]);
        for (std::int32_t y = y0; y <= y1; ++y) {
            const auto bar = y0 == y1 ? slab : slab_of(slab, 1, y - slack, y + 1 + slack);
            if (bar.empty()) continue;
            const auto [x0, x1] = range_of(bar, 0, cells[0]);
            const std::size_t row = static_cast<std::size_t>(cells[0]) *
                                    (static_cast<std::size_t>(y) +
                                     static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(z));
            for (std::int32_t x = x0; x <= x1; ++x)
                std::atomic_ref(marks[row + static_cast<std::size_t>(x)]).store(1, std::memory_order_relaxed);
        }
    }
}

} // namespace

TouchedCells touched_cells(const Surface& surface, double size, std::size_t max_cells) {
    const Box box = surface.bounds();
    const Vec3 extent = box.extent();
    const auto count = [&](std::size_t k) { return std::floor(extent[k] / size) + 1; };
    while (count(0) * count(1) * count(2) > static_cast<double>(max_cells)) size *= 1.05;
    CellCounts cells{};
    std::size_t all = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        cells[k] = static_cast<std::int32_t>(count(k));
        all *= static_cast<std::size_t>(cells[k]);
    }
    std::vector<std::uint8_t> marks(all);
    parallel_for(
        surface.size(),
        [&](std::size_t t) {
            std::vector<Vec3> triangle;
            triangle.reserve(3);
            for (std::size_t c = 0; c < 3; ++c) {
                const Vec3& p = surface.point(t, c);
                if (!is_finite(p)) return;
                triangle.push_back((p - box.min) / size);
            }
            mark_cells(triangle, cells, marks);
        },
        256);
    return {static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1)), size};
}

} // namespace facetmill
