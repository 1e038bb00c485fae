#include "geometry/deviation/deviation.hpp"

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/deviation/bound.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/power_scale.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// The area up to and including each triangle; triangles that are not finite have none.
std::vector<double> areas_up_to(const Surface& surface) {
    std::vector<double> areas(surface.size());
    parallel_for(areas.size(), [&](std::size_t t) {
        const Vec3& a = surface.point(t, 0);
        const double area = length(cross(surface.point(t, 1) - a, surface.point(t, 2) - a)) / 2;
        areas[t] = std::isfinite(area) ? area : 0;
    });
    double sum = 0;
    for (double& area : areas) area = sum += area;
    return areas;
}

double fraction(double x) { return x - std::floor(x); }

/// The finite points that triangles use, in order along a curve.
std::vector<Vec3> used_points(const Surface& surface) {
    std::vector<std::uint8_t> used(surface.positions.size());
    for (const Index v : surface.corners) used[v] = is_finite(surface.positions[v]);
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) points.push_back(surface.positions[v]);
    const auto order = order_of_queries(points);
    std::vector<Vec3> along(points.size());
    parallel_for(points.size(), [&](std::size_t i) { along[i] = points[order[i]]; });
    return along;
}

struct Farthest {
    Vec3 from, to;
    double distance = -1;
};

/// The farthest of the points, when it is beyond `least`. A point that turns out nearer than one before it
/// need not be searched to the end.
Farthest farthest_of(const FaceTree& tree, const std::vector<Vec3>& points, double least) {
    return parallel_reduce(
        points.size(), Farthest{},
        [&](std::size_t begin, std::size_t end) {
            Farthest best{{}, {}, least};
            Index hint = none;
            for (std::size_t i = begin; i < end; ++i) {
                const Closest c = closest_point(tree, points[i], hint, best.distance);
                hint = c.triangle;
                if (c.distance > best.distance) best = {points[i], c.point, c.distance};
            }
            return best;
        },
        [](const Farthest& a, const Farthest& b) { return b.distance > a.distance ? b : a; }, 1024);
}

struct DistanceSums {
    double distances = 0, squares = 0;
};

/// The maximum, mean and rms of the distances of these points; face_of(i) is where the i-th lies.
template <class FaceOf>
void measure_points(DirectedDeviation& d, const std::vector<Vec3>& points, const std::vector<Closest>& found,
                    FaceOf&& face_of) {
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].distance > d.maximum) {
            d.maximum = found[i].distance;
            d.from = points[i];
            d.to = found[i].point;
            d.face = face_of(i);
        }
    const DistanceSums sums = parallel_reduce(
        found.size(), DistanceSums{},
        [&](std::size_t begin, std::size_t end) {
            DistanceSums s;
            for (std::size_t i = begin; i < end; ++i) {
                s.distances += found[i].distance;
                s.squares += found[i].distance * found[i].distance;
            }
            return s;
        },
        [](const DistanceSums& a, const DistanceSums& b) {
            return DistanceSums{a.distances + b.distances, a.squares + b.squares};
        });
    if (found.empty()) return;
    d.mean = sums.distances / static_cast<double>(found.size());
    d.rms = std::sqrt(sums.squares / static_cast<double>(found.size()));
}

void measure_area(DirectedDeviation& d, const Surface& from, const FaceTree& to,
                  const std::vector<SurfaceSample>& samples) {
    std::vector<Vec3> points(samples.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = samples[i].point;
    d.samples = samples.size();
    auto found = closest_points(to, points);
    parallel_for(found.size(),
                 [&](std::size_t i) { found[i].distance = told_from_zero(found[i].distance, points[i]); });
    measure_points(d, points, found, [&](std::size_t i) { return from.face(samples[i].triangle); });
}

} // namespace

std::vector<SurfaceSample> sample_area(const Surface& surface, std::size_t count, std::uint64_t seed) {
    const std::vector<double> areas = areas_up_to(surface);
    if (areas.empty() || !(areas.back() > 0) || !std::isfinite(areas.back())) return {};
    std::vector<SurfaceSample> samples(count);
    const auto start = [&](std::uint64_t i) { return uniform(hashed(seed, i)); };
    const double start_u = start(0), start_v = start(1);
    parallel_for(count, [&](std::size_t k) {
        const auto n = static_cast<double>(k);
        const double at = (n + start(k + 2)) / static_cast<double>(count) * areas.back();
        // The last triangle when rounding leads past the end; it need not have an area, which does no harm.
        const auto found = std::upper_bound(areas.begin(), areas.end(), at);
        const auto t = static_cast<std::size_t>(found == areas.end() ? found - areas.begin() - 1
                                                                     : found - areas.begin());
        // Roberts' additive sequence in the plane fills large triangles more evenly than chance.
        double u = fraction(start_u + n * 0.7548776662466927), v = fraction(start_v + n * 0.5698402909980532);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const Vec3& a = surface.point(t, 0);
        samples[k] = {a + (surface.point(t, 1) - a) * u + (surface.point(t, 2) - a) * v,
                      static_cast<Index>(t)};
    });
    return samples;
}

std::optional<double> DeviationResult::bound() const {
    if (!forward.bound || !backward.bound) return {};
    return std::max(*forward.bound, *backward.bound);
}

double DeviationResult::percent(double length) const {
    return length == 0 ? 0 : diagonal > 0 ? length / diagonal * 100 : HUGE_VAL;
}

DirectedDeviation deviation_to(const Surface& from, const FaceTree& to, const DeviationSettings& settings) {
    DirectedDeviation d;
    const std::vector<Vec3> vertices = used_points(from);
    d.vertices = vertices.size();
    if (vertices.empty()) {
        if (settings.certify) d.bound = 0;
        return d;
    }
    if (to.empty()) {
        d.maximum = d.rms = d.mean = HUGE_VAL;
        if (settings.certify) d.bound = HUGE_VAL;
        return d;
    }
    const auto samples = sample_area(from, settings.samples, settings.seed);
    if (samples.empty()) {
        measure_points(d, vertices, closest_points(to, vertices), [](std::size_t) { return none; });
    } else {
        measure_area(d, from, to, samples);
        const Farthest vertex = farthest_of(to, vertices, d.maximum);
        if (vertex.distance > d.maximum) {
            d.maximum = vertex.distance;
            d.from = vertex.from;
            d.to = vertex.to;
            d.face = none;
        }
    }
    if (settings.certify) bound_deviation(d, from, to, settings);
    return d;
}

namespace {

/// The length that half of about 64 triangles exceed.
double usual_length(const Surface& surface) {
    std::vector<double> lengths;
    for (std::size_t t = 0; t < surface.size(); t += surface.size() / 64 + 1) {
        const Vec3 &a = surface.point(t, 0), &b = surface.point(t, 1), &c = surface.point(t, 2);
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        if (std::isfinite(longest)) lengths.push_back(longest);
    }
    if (lengths.empty()) return 0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

/// Whether most of about 64 points of a surface are farther from another than its triangles are long.
bool is_far(const Surface& from, const Surface& to, const FaceTree& tree) {
    if (tree.empty()) return false;
    const double near = usual_length(to);
    std::size_t looked_at = 0;
    std::size_t far = 0;
    for (std::size_t t = 0; t < from.size(); t += from.size() / 64 + 1) {
        ++looked_at;
        if (!(closest_point(tree, from.point(t, 0), none, near).distance <= near)) ++far;
    }
    return 2 * far > looked_at;
}

DirectedDeviation deviation_between(const Surface& from, const Surface& to,
                                    const DeviationSettings& settings) {
    FaceTree tree(to, FaceTree::Use::near);
    if (is_far(from, to, tree)) tree.flatten();
    return deviation_to(from, tree, settings);
}

Surface scaled(Surface surface, const PowerScale& scale) {
    surface.positions = scale(surface.positions);
    return surface;
}

/// Of surfaces that were scaled: what it is of them as they were.
void unscale(DirectedDeviation& d, const PowerScale& scale) {
    for (double* x : {&d.maximum, &d.rms, &d.mean}) *x = unscaled(*x, scale.powers[0]);
    if (d.bound) d.bound = unscaled(*d.bound, scale.powers[0]);
    d.from = scale.inverse()(d.from);
    d.to = scale.inverse()(d.to);
}

} // namespace

DeviationResult deviation(const Surface& first, const Surface& second, const DeviationSettings& settings) {
    Box both = first.bounds();
    both.add(second.bounds());
    if (const PowerScale scale = even_scale(both); !scale.none()) {
        DeviationResult far = deviation(scaled(first, scale), scaled(second, scale), settings);
        unscale(far.forward, scale);
        unscale(far.backward, scale);
        far.diagonal = unscaled(far.diagonal, scale.powers[0]);
        return far;
    }
    DeviationResult result;
    result.seed = settings.seed;
    result.diagonal = diagonal(first.bounds());
    result.forward = deviation_between(first, second, settings); // one tree at a time
    result.backward = deviation_between(second, first, settings);
    const bool one_empty = (result.forward.vertices == 0) != (result.backward.vertices == 0);
    if (one_empty)
        for (auto* d : {&result.forward, &result.backward}) d->maximum = d->rms = d->mean = HUGE_VAL;
    return result;
}

DeviationResult deviation(const Mesh& first, const Mesh& second, const DeviationSettings& settings) {
    return deviation(filled_surface(first), filled_surface(second), settings);
}

} // namespace facetmill
