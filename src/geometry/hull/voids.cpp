#include "geometry/hull/voids.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

/// The stretches of the rows of cells between the surfaces of a convex body.
class RowStretches {
  public:
    RowStretches(const SolidGrid& grid, const ConvexSurface& hull) : hull_(hull) {
        const Box box = box_of(hull.points);
        for (std::size_t k = 0; k < 3; ++k) {
            low_[k] = first_centre(box.min[k], grid.cells()[k]);
            high_[k] = first_centre(box.max[k], grid.cells()[k]);
        }
        rows_.assign(static_cast<std::size_t>(high_[1] - low_[1]) *
                         static_cast<std::size_t>(high_[2] - low_[2]),
                     {HUGE_VAL, -HUGE_VAL});
        for (const auto& t : hull.triangles) add(t);
    }

    /// Calls visit with each cell whose centre is inside.
    template <class Visit>
    void for_each(const SolidGrid& grid, Visit&& visit) const {
        const std::int32_t cells = grid.cells()[0];
        for (std::int32_t z = low_[2]; z < high_[2]; ++z)
            for (std::int32_t y = low_[1]; y < high_[1]; ++y) {
                const auto [from, to] = rows_[row(y, z)];
                if (!(from <= to)) continue;
                const std::int32_t end = first_centre(to, cells);
                const std::size_t start = grid.index({0, y, z});
                for (std::int32_t x = first_centre(from, cells); x < end; ++x)
                    visit(start + static_cast<std::size_t>(x));
            }
    }

  private:
    /// The first cell whose centre is not below x, at most the number of cells.
    static std::int32_t first_centre(double x, std::int32_t cells) {
        return static_cast<std::int32_t>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(cells)));
    }
    std::size_t row(std::int32_t y, std::int32_t z) const {
        return static_cast<std::size_t>(y - low_[1]) +
               static_cast<std::size_t>(high_[1] - low_[1]) * static_cast<std::size_t>(z - low_[2]);
    }
    /// Where the triangle crosses each layer of centres, and each row of it.
    void add(const std::array<Index, 3>& t) {
        double bottom = HUGE_VAL, top = -HUGE_VAL;
        for (const Index v : t) {
            bottom = std::min(bottom, hull_.points[v].z);
            top = std::max(top, hull_.points[v].z);
        }
        const std::int32_t end = std::min(first_centre(top, high_[2]), high_[2]);
        for (std::int32_t z = std::max(first_centre(bottom, high_[2]), low_[2]); z < end; ++z) {
            std::array<Vec3, 2> ends;
            std::size_t n = 0;
            for (std::size_t i = 0; i < 3 && n < 2; ++i)
                // From the lower number, so that both triangles at an edge get the same point.
                n += crossing(hull_.points[std::min(t[i], t[(i + 1) % 3])],
                              hull_.points[std::max(t[i], t[(i + 1) % 3])], 2, z + 0.5, ends[n]);
            if (n == 2) add_segment(ends[0], ends[1], z);
        }
    }
    void add_segment(const Vec3& a, const Vec3& b, std::int32_t z) {
        const std::int32_t end = std::min(first_centre(std::max(a.y, b.y), high_[1]), high_[1]);
        for (std::int32_t y = std::max(first_centre(std::min(a.y, b.y), high_[1]), low_[1]); y < end; ++y) {
            Vec3 at;
            if (!crossing(a, b, 1, y + 0.5, at)) continue;
            auto& [from, to] = rows_[row(y, z)];
            from = std::min(from, at.x);
            to = std::max(to, at.x);
        }
    }
    static bool crossing(const Vec3& a, const Vec3& b, std::size_t axis, double at, Vec3& out) {
        if ((a[axis] <= at) == (b[axis] <= at)) return false;
        out = mix(a, b, (at - a[axis]) / (b[axis] - a[axis]));
        return true;
    }

    const ConvexSurface& hull_;
    Cell low_{}, high_{};
    std::vector<std::array<double, 2>> rows_;
};

} // namespace

Voids voids_of(const SolidGrid& grid, const ConvexSurface& hull) {
    Voids all;
    std::uint32_t farthest = 0;
    RowStretches(grid, hull).for_each(grid, [&](std::size_t cell) {
        const std::uint32_t distance = grid.square_distance(cell);
        farthest = std::max(farthest, distance);
        all.cells += distance > 0;
    });
    all.distance = std::sqrt(static_cast<double>(farthest));
    return all;
}

} // namespace facetmill
