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

/// Sums area vectors by direction, in cells of 1/64, and gives their directions by falling area.
class DirectionTally {
  public:
    void add(const Vec3& area) {
        const Vec3 n = normalised(area);
        if (!is_finite(n) || n == Vec3{}) return;
        Vec3& sum = sums_[{std::round(n.x * 64), std::round(n.y * 64), std::round(n.z * 64)}];
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
    std::map<std::array<double, 3>, Vec3> sums_;
};

class PrintDirections {
  public:
    PrintDirections(const Surface& surface, const Vec3& up, const PrintDirectionSettings& settings)
        : surface_(surface), up_(up), steepest_(cosine(settings.overhang_angle) + 1e-6),
          hull_(convex_hull(surface.positions)), box_(surface.bounds()), on_plate_(4 * float32_ulp(box_)) {
        areas_.reserve(surface.size());
        for (std::size_t t = 0; t < surface.size(); ++t) {
            areas_.push_back(twice_area({surface.point(t, 0), surface.point(t, 1), surface.point(t, 2)}) *
                             0.5);
            total_ += length(areas_.back());
        }
        for (const auto& t : hull_) corners_.insert(corners_.end(), t.begin(), t.end());
        if (corners_.empty()) corners_ = surface.positions;
        const auto before = [](const Vec3& a, const Vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        std::sort(corners_.begin(), corners_.end(), before);
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    }

    PrintDirectionResult run() const {
        std::vector<PrintDirection> tried = measured(candidates());
        const PrintDirection before = tried.front();
        std::vector<PrintDirection> best = best_of(std::move(tried), 4);
        for (PrintDirection& d : best) refine(d);
        PrintDirection after = best.front();
        for (const PrintDirection& d : best)
            if (is_better(d, after)) after = d;
        return {before, after};
    }

  private:
    std::vector<Vec3> candidates() const {
        std::vector<Vec3> all{up_};
        DirectionTally hull, own;
        for (const auto& t : hull_) hull.add(twice_area(t));
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

    bool is_better(const PrintDirection& a, const PrintDirection& b) const {
        const auto differ = [](double x, double y, double scale) { return std::fabs(x - y) > 1e-9 * scale; };
        if (differ(a.overhang, b.overhang, total_)) return a.overhang < b.overhang;
        if (differ(a.height, b.height, box_.diagonal())) return a.height < b.height;
        return dot(a.up, up_) > dot(b.up, up_) + 1e-9;
    }

    /// The best directions, each at least about 8 degrees from those before it.
    std::vector<PrintDirection> best_of(std::vector<PrintDirection> all, std::size_t most) const {
        std::vector<PrintDirection> best;
        while (best.size() < most && !all.empty()) {
            std::size_t first = 0;
            for (std::size_t i = 1; i < all.size(); ++i)
                if (is_better(all[i], all[first])) first = i;
            best.push_back(all[first]);
            std::erase_if(all, [&](const PrintDirection& d) { return dot(d.up, best.back().up) > 0.99; });
        }
        return best;
    }

    /// Turns the direction in eight ways while this improves it.
    void refine(PrintDirection& d) const {
        for (double step = 0.14; step > 0.008; step /= 2)
            for (int tries = 0; tries < 8; ++tries) {
                const Vec3 side = normalised(std::fabs(d.up.x) < 0.9 ? cross(d.up, Vec3{1, 0, 0})
                                                                     : cross(d.up, Vec3{0, 1, 0}));
                const Vec3 other = cross(d.up, side);
                std::vector<Vec3> around;
                for (int i = -1; i <= 1; ++i)
                    for (int j = -1; j <= 1; ++j)
                        if (i != 0 || j != 0)
                            around.push_back(normalised(d.up + side * (i * step) + other * (j * step)));
                bool improved = false;
                for (const PrintDirection& near : measured(around))
                    if (is_better(near, d)) {
                        d = near;
                        improved = true;
                    }
                if (!improved) break;
            }
    }

    const Surface& surface_;
    Vec3 up_;
    double steepest_; ///< the share of its area that an overhanging face at least turns down
    std::vector<std::array<Vec3, 3>> hull_;
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
