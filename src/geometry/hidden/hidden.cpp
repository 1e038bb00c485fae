#include "geometry/hidden/hidden.hpp"

#include "base/error.hpp"
#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "geometry/spatial/rays.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

/// The 6 axes and the 8 diagonals of a cube.
std::vector<Vec3> outer_directions() {
    std::vector<Vec3> all;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            Vec3 d;
            d[axis] = sign;
            all.push_back(d);
        }
    for (int corner = 0; corner < 8; ++corner)
        all.push_back(
            normalised(Vec3{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0}));
    return all;
}

/// Directions along a spiral of equal areas (R. Swinbank and R. J. Purser, "Fibonacci grids", 2006).
std::vector<Vec3> even_directions(std::size_t count) {
    constexpr double golden_angle = 2.399963229728653;
    std::vector<Vec3> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double r = std::sqrt(std::max(0.0, 1 - z * z)), turn = golden_angle * static_cast<double>(i);
        all[i] = {r * cosine(turn), r * sine(turn), z};
    }
    return all;
}

/// The number of rays along a side of the square grid that covers the box in any direction.
double rays_along(const Box& box, double gap) {
    return std::ceil(box.diagonal() / gap * 1.4142135623730951) + 1;
}

constexpr std::size_t batch = std::size_t{1} << 18; ///< rays at once

class HiddenSearch {
  public:
    HiddenSearch(const Surface& surface, const FaceTree& tree, std::size_t faces,
                 const HiddenSettings& settings)
        : surface_(surface), tree_(tree), settings_(settings), box_(surface.bounds()) {
        result_.flags.assign(faces, 1);
    }

    HiddenFaces run() {
        ProgressSteps steps({1, 4});
        for (const Vec3& d : outer_directions()) look_from_outside(d);
        steps.next();
        const std::vector<Vec3> directions = even_directions(settings_.directions);
        for (std::size_t sample = 0; sample < 4; ++sample)
            for (std::size_t i = 0; i < directions.size(); ++i) {
                ProgressScope::report_item(sample * directions.size() + i, 4 * directions.size());
                look_outward(sample, directions[i]);
            }
        keep_neighbours();
        return std::move(result_);
    }

  private:
    void look_from_outside(const Vec3& d) {
        const Vec3 side = normalised(cross(d, std::abs(d.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        const Vec3 up = cross(d, side), centre = box_.centre() - d * box_.diagonal();
        const auto n = static_cast<std::size_t>(rays_along(box_, settings_.gap));
        const double spacing = settings_.gap / 1.4142135623730951;
        const auto ray = [&](std::size_t i) {
            const auto offset = [&](std::size_t k) {
                return (static_cast<double>(k) - static_cast<double>(n - 1) / 2) * spacing;
            };
            const Vec3 from = centre + side * offset(i % n) + up * offset(i / n);
            return Line{from, from + d * box_.diagonal(), true};
        };
        for (std::size_t begin = 0; begin < n * n; begin += batch) {
            std::vector<Line> lines(std::min(batch, n * n - begin));
            parallel_for(lines.size(), [&](std::size_t i) { lines[i] = ray(begin + i); });
            for (const Hit& hit : hits_of(tree_, lines, false).hits) result_.flags[hit.face] = 0;
        }
        result_.outer_rays += n * n;
    }

    /// Casts rays from a point of each hidden triangle.
    void look_outward(std::size_t sample, const Vec3& d) {
        const double start = 1e-6 * box_.diagonal();
        for (std::size_t t = 0; t < surface_.size();) {
            std::vector<Line> lines;
            std::vector<Index> faces;
            lines.reserve(std::min(batch, surface_.size() - t));
            faces.reserve(lines.capacity());
            for (; t < surface_.size() && lines.size() < batch; ++t) {
                const Index face = surface_.face(t);
                if (!result_.flags[face]) continue;
                const Vec3 &a = surface_.point(t, 0), &b = surface_.point(t, 1), &c = surface_.point(t, 2);
                const double w[3] = {sample == 1 ? 0.9 : 0.05, sample == 2 ? 0.9 : 0.05,
                                     sample == 3 ? 0.9 : 0.05};
                const Vec3 p = sample == 0 ? (a + b + c) / 3 : a * w[0] + b * w[1] + c * w[2];
                if (!is_finite(p)) {
                    result_.flags[face] = 0;
                    continue;
                }
                lines.push_back({p + d * start, p + d * box_.diagonal(), true});
                faces.push_back(face);
            }
            const HitLists hits = hits_of(tree_, lines, false);
            for (std::size_t i = 0; i < lines.size(); ++i)
                if (hits.of(i).empty()) result_.flags[faces[i]] = 0;
            result_.face_rays += lines.size();
        }
    }

    void keep_neighbours() {
        std::vector<std::uint8_t> at_reached(surface_.positions.size());
        for (std::size_t t = 0; t < surface_.size(); ++t)
            for (std::size_t k = 0; k < 3 && !result_.flags[surface_.face(t)]; ++k)
                at_reached[surface_.corners[3 * t + k]] = 1;
        for (std::size_t t = 0; t < surface_.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                if (at_reached[surface_.corners[3 * t + k]]) result_.flags[surface_.face(t)] = 0;
    }

    const Surface& surface_;
    const FaceTree& tree_;
    HiddenSettings settings_;
    Box box_;
    HiddenFaces result_;
};

} // namespace

double outer_ray_count(const Box& box, double gap) {
    const double along = rays_along(box, gap);
    return static_cast<double>(outer_directions().size()) * along * along;
}

HiddenFaces hidden_faces(const Surface& surface, const FaceTree& tree, std::size_t faces,
                         const HiddenSettings& settings) {
    if (tree.empty()) return {std::vector<std::uint8_t>(faces), 0, 0};
    constexpr double most = 1e8;
    const double rays = outer_ray_count(surface.bounds(), settings.gap);
    if (!(rays <= most))
        throw Error(ErrorKind::limit, "E-LIMIT",
                    fmt::format("hidden faces need {:.3g} rays for this gap, but at most {:.0e} are possible",
                                rays, most),
                    "give a larger gap");
    return HiddenSearch(surface, tree, faces, settings).run();
}

} // namespace facetmill
