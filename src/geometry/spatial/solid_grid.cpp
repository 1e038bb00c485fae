#include "geometry/spatial/solid_grid.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

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

/// Replaces each value of a line by the smallest value[j] + (i - j)^2.
void spread_distances(std::vector<std::uint32_t>& line, std::vector<std::uint32_t>& out) {
    const auto n = static_cast<std::int64_t>(line.size());
    if (std::adjacent_find(line.begin(), line.end(), std::not_equal_to<>()) == line.end()) {
        out = line;
        return;
    }
    for (std::int64_t i = 0; i < n; ++i) {
        std::int64_t best = line[static_cast<std::size_t>(i)];
        for (std::int64_t d = 1; d * d < best && d < n; ++d)
            for (const std::int64_t j : {i - d, i + d})
                if (j >= 0 && j < n) best = std::min(best, line[static_cast<std::size_t>(j)] + d * d);
        out[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(best);
    }
}

} // namespace

SolidGrid::SolidGrid(const Surface& surface, double cell_size, std::size_t max_cells) : size_(cell_size) {
    const Box box = surface.bounds();
    const Vec3 extent = box.extent();
    const auto many = [&] {
        double product = 1;
        for (std::size_t k = 0; k < 3; ++k) product *= std::ceil(extent[k] / size_) + 3;
        return product;
    };
    while (many() > static_cast<double>(max_cells)) size_ *= 1.05;
    for (std::size_t k = 0; k < 3; ++k) {
        cells_[k] = static_cast<std::int32_t>(std::ceil(extent[k] / size_)) + 3;
        origin_[k] = box.centre()[k] - size_ * cells_[k] / 2;
    }
    solid_.assign(index({0, 0, cells_[2]}), 0);
    mark_surface(surface);
    touched_ = static_cast<std::size_t>(std::count(solid_.begin(), solid_.end(), 1));
    fill();
}

Cell SolidGrid::cell_at(const Vec3& p, const CellBox& box) const {
    const Vec3 at = in_cells(p);
    Cell c{};
    for (std::size_t k = 0; k < 3; ++k)
        c[k] = std::clamp(floored(at[k], cells_[k]), box.low[k], box.high[k] - 1);
    return c;
}

void SolidGrid::mark_surface(const Surface& surface) {
    parallel_for(
        surface.size(),
        [&](std::size_t t) {
            std::vector<Vec3> triangle;
            for (std::size_t c = 0; c < 3; ++c) triangle.push_back(in_cells(surface.point(t, c)));
            if (!is_finite(triangle[0]) || !is_finite(triangle[1]) || !is_finite(triangle[2])) return;
            const auto [z0, z1] = range_of(triangle, 2, cells_[2]);
            for (std::int32_t z = z0; z <= z1; ++z) {
                const auto slab = z0 == z1 ? triangle : slab_of(triangle, 2, z - slack, z + 1 + slack);
                if (slab.empty()) continue;
                const auto [y0, y1] = range_of(slab, 1, cells_[1]);
                for (std::int32_t y = y0; y <= y1; ++y) {
                    const auto bar = y0 == y1 ? slab : slab_of(slab, 1, y - slack, y + 1 + slack);
                    if (bar.empty()) continue;
                    const auto [x0, x1] = range_of(bar, 0, cells_[0]);
                    for (std::int32_t x = x0; x <= x1; ++x)
                        std::atomic_ref(solid_[index({x, y, z})]).store(1, std::memory_order_relaxed);
                }
            }
        },
        256);
}

void SolidGrid::fill() {
    constexpr std::uint8_t outside = 2;
    std::vector<Cell> stack{{0, 0, 0}};
    solid_[0] = outside;
    while (!stack.empty()) {
        const Cell c = stack.back();
        stack.pop_back();
        for (std::size_t k = 0; k < 3; ++k)
            for (const int step : {-1, 1}) {
                Cell next = c;
                next[k] += step;
                if (next[k] < 0 || next[k] >= cells_[k]) continue;
                std::uint8_t& value = solid_[index(next)];
                if (value != 0) continue;
                value = outside;
                stack.push_back(next);
            }
    }
    for (std::uint8_t& value : solid_) value = value != outside;
}

void SolidGrid::measure_distances() {
    const auto longest = static_cast<std::uint32_t>(cells_[0] + cells_[1] + cells_[2]);
    square_distance_.resize(solid_.size());
    for (std::size_t i = 0; i < solid_.size(); ++i) square_distance_[i] = solid_[i] ? 0 : longest * longest;
    std::size_t stride = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto n = static_cast<std::size_t>(cells_[k]);
        parallel_for(
            solid_.size() / n,
            [&](std::size_t l) {
                const std::size_t begin = l / stride * stride * n + l % stride;
                std::vector<std::uint32_t> line(n), out(n);
                for (std::size_t i = 0; i < n; ++i) line[i] = square_distance_[begin + i * stride];
                spread_distances(line, out);
                for (std::size_t i = 0; i < n; ++i) square_distance_[begin + i * stride] = out[i];
            },
            256);
        stride *= n;
    }
}

} // namespace facetmill
