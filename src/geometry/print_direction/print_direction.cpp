#include "geometry/print_direction/print_direction.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/cgal/convex_hull.hpp"
#include "mesh/float32_ulp.hpp"
#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace facetmill {

namespace {

Vec3 twice_area(const std::array<Vec3, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// Sums area vectors by direction, in cells of this size, and gives their directions by falling area.
class DirectionTally {
  public:
    explicit DirectionTally(double cell) : cells_(1 / cell) {}

    void add(const Vec3& area) {
        const Vec3 n = normalised(area);
        if (!is_finite(n) || n == Vec3{}) return;
        Vec3& sum = sums_[{std::round(n.x * cells_), std::round(n.y * cells_), std::round(n.z * cells_)}];
        sum += area;
    }
    std::vector<Vec3> largest(std::size_t most) const {
        std::vector<Vec3> all;
        all.reserve(sums_.size());
        for (const auto& [cell, sum] : sums_) all.push_back(sum);
        std::stable_sort(all.begin(), all.end(),
                         [](const Vec3& a, const Vec3& b) { return dot(a, a) > dot(b, b); });
        if (all.size() > most) all.resize(most);
        for (Vec3& v : all) v = normalised(v);
        return all;
    }

  private:
    double cells_;
    std::map<std::array<double, 3>, Vec3> sums_;
};

/// The hull, or nothing for fewer than three finite points.
ConvexSurface hull_of(const std::vector<Vec3>& positions) {
    std::vector<Vec3> finite;
    finite.reserve(positions.size());
    for (const Vec3& p : positions)
        if (is_finite(p)) finite.push_back(p);
    return finite.size() < 3 ? ConvexSurface{} : convex_surface(finite);
}

class PrintDirections {
  public:
    PrintDirections(const Surface& surface, const Vec3& up, const PrintDirectionSettings& settings)
        : surface_(surface), up_(up), steepest_(cosine(settings.overhang_angle) + 1e-6),
          hull_(hull_of(surface.positions)), box_(surface.bounds()), on_plate_(4 * float32_ulp(box_)) {
        areas_.reserve(surface.size());
        for (std::size_t t = 0; t < surface.size(); ++t) {
            areas_.push_back(twice_area({surface.point(t, 0), surface.point(t, 1), surface.point(t, 2)}) *
                             0.5);
            total_ += length(areas_.back());
        }
        corners_ = hull_.points.empty() ? surface.positions : hull_.points;
    }

    PrintDirectionResult run() const {
        std::vector<PrintDirection> tried = measured(candidates());
        const PrintDirection before = tried.front();
        for (PrintDirection& d : best_of(tried, 4, has_less_overhang)) {
            refine(d, has_less_overhang);
            tried.push_back(d);
        }
        const double limit =
            std::min_element(tried.begin(), tried.end(), has_less_overhang)->overhang + total_ / 1000;
        std::erase_if(tried, [&](const PrintDirection& d) { return d.overhang > limit; });
        const auto is_lower = [&](const PrintDirection& a, const PrintDirection& b) {
            return a.overhang <= limit && a.height < b.height;
        };
        for (PrintDirection& d : best_of(tried, 8, is_lower)) {
            refine(d, is_lower);
            tried.push_back(d);
        }
        return {before, nearest_of_lowest(tried)};
    }

  private:
    std::vector<Vec3> candidates() const {
        std::vector<Vec3> all{up_};
        // A face of the hull lies flat on the plate only in exactly its own direction, so hull directions are
        // tallied finely.
        DirectionTally hull(1.0 / 4096), own(1.0 / 64);
        for (const auto& t : hull_.triangles)
            hull.add(twice_area({hull_.points[t[0]], hull_.points[t[1]], hull_.points[t[2]]}));
        for (const Vec3& area : areas_) own.add(area);
        for (const Vec3& n : hull.largest(128)) all.push_back(-n);
        for (const Vec3& n : own.largest(64)) {
            all.push_back(-n);
            all.push_back(n);
        }
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (x != 0 || y != 0 || z != 0)
                        all.push_back(normalised(
                            {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
        for (const Vec3& p : shapes::icosphere(2).positions) all.push_back(normalised(p));
        return all;
    }

    PrintDirection measure(const Vec3& up) const {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const Vec3& p : corners_) {
            low = std::min(low, dot(p, up));
            high = std::max(high, dot(p, up));
        }
        const double plate = low + on_plate_;
        double overhang = 0;
        for (std::size_t t = 0; t < areas_.size(); ++t) {
            const double down = -dot(areas_[t], up);
            if (!(down > 0)) continue;
            const double area = length(areas_[t]);
            if (!(down > area * steepest_)) continue;
            const bool lies = dot(surface_.point(t, 0), up) <= plate &&
                              dot(surface_.point(t, 1), up) <= plate &&
                              dot(surface_.point(t, 2), up) <= plate;
            if (!lies) overhang += area;
        }
        return {up, overhang, high - low};
    }
    std::vector<PrintDirection> measured(const std::vector<Vec3>& directions) const {
        std::vector<PrintDirection> all(directions.size());
        parallel_for(
            all.size(), [&](std::size_t i) { all[i] = measure(directions[i]); }, 1);
        return all;
    }

    static bool has_less_overhang(const PrintDirection& a, const PrintDirection& b) {
        return std::tie(a.overhang, a.height) < std::tie(b.overhang, b.height);
    }

    /// Rounding does not decide between equal heights: the smallest turn does.
    PrintDirection nearest_of_lowest(const std::vector<PrintDirection>& all) const {
        double height = HUGE_VAL;
        for (const PrintDirection& d : all) height = std::min(height, d.height);
        const PrintDirection* nearest = nullptr;
        for (const PrintDirection& d : all)
            if (d.height <= height + 1e-9 * box_.diagonal() &&
                (!nearest || dot(d.up, up_) > dot(nearest->up, up_)))
                nearest = &d;
        return *nearest;
    }

    /// The best directions, each at least about 8 degrees from those before it.
    template <class Better>
    static std::vector<PrintDirection> best_of(std::vector<PrintDirection> all, std::size_t most,
                                               const Better& is_better) {
        std::vector<PrintDirection> best;
        best.reserve(most);
        while (best.size() < most && !all.empty()) {
            best.push_back(*std::min_element(all.begin(), all.end(), is_better));
            std::erase_if(all, [&](const PrintDirection& d) { return dot(d.up, best.back().up) > 0.99; });
        }
        return best;
    }

    /// Turns the direction in eight ways while this improves it.
    template <class Better>
    void refine(PrintDirection& d, const Better& is_better) const {
        for (double step = 0.14; step > 0.008; step /= 2)
            for (int tries = 0; tries < 8; ++tries) {
                bool improved = false;
                for (const PrintDirection& near : measured(around(d.up, step)))
                    if (is_better(near, d)) {
                        d = near;
                        improved = true;
                    }
                if (!improved) break;
            }
    }
    static std::vector<Vec3> around(const Vec3& up, double step) {
        const Vec3 side =
            normalised(std::fabs(up.x) < 0.9 ? cross(up, Vec3{1, 0, 0}) : cross(up, Vec3{0, 1, 0}));
        const Vec3 other = cross(up, side);
        std::vector<Vec3> all;
        all.reserve(8);
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                if (i != 0 || j != 0) all.push_back(normalised(up + side * (i * step) + other * (j * step)));
        return all;
    }

    const Surface& surface_;
    Vec3 up_;
    double steepest_; ///< overhanging faces look down by more than this share of their area
    ConvexSurface hull_;
    Box box_;
    double on_plate_ = 0, total_ = 0;
    std::vector<Vec3> areas_, corners_; ///< of triangles; of the hull
};

} // namespace

PrintDirectionResult find_print_direction(const Surface& surface, const Vec3& up,
                                          const PrintDirectionSettings& settings) {
    return PrintDirections(surface, up, settings).run();
}

Transform turn_onto(const Vec3& from, const Vec3& to) {
    Vec3 k = cross(from, to);
    const double c = dot(from, to);
    const double share = 1 / (1 + c); // (1 - c) / |k|^2
    if (!(1 + c > 1e-12)) {           // half a turn about any perpendicular axis
        k = normalised(std::fabs(from.x) < 0.9 ? cross(from, Vec3{1, 0, 0}) : cross(from, Vec3{0, 1, 0}));
        Transform half;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) half.m[i][j] = 2 * k[i] * k[j] - (i == j ? 1 : 0);
        return half;
    }
    Transform t;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = (i == j ? c : 0) + share * k[i] * k[j];
    t.m[0][1] -= k.z;
    t.m[1][0] += k.z;
    t.m[0][2] += k.y;
    t.m[2][0] -= k.y;
    t.m[1][2] -= k.x;
    t.m[2][1] += k.x;
    return t;
}

} // namespace facetmill
