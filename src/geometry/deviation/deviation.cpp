#include "geometry/deviation/deviation.hpp"

#include "base/progress.hpp"
#include "geometry/deviation/bound.hpp"
#include "geometry/deviation/itself.hpp"
#include "geometry/deviation/sample_walk.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/dense_box.hpp"
#include "geometry/spatial/hilbert_curve.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

constexpr double unmeasured = MeasuredSamples::unmeasured;
constexpr std::size_t all_parts = MeasuredSamples::all_parts;

struct DistanceSums {
    std::size_t count = 0;
    double distances = 0, squares = 0,
           differences = 0; ///< sums; differences: squared differences between the squares of neighbours

    DistanceSums plus(const DistanceSums& b) const {
        return {count + b.count, distances + b.distances, squares + b.squares, differences + b.differences};
    }
    double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
    /// The standard error of the RMS, relative to the RMS; infinity if the RMS is 0. Samples are in
    /// consecutive equal parts of the area, so differences of neighbours estimate the random error. After W.
    /// G. Cochran, "Sampling Techniques" (1977), 8.11.
    double error() const { return squares > 0 ? std::sqrt(differences / 2) / squares / 2 : HUGE_VAL; }
};

/// Sums over the samples of the first `parts` parts.
DistanceSums sums_of(const std::vector<double>& distances, std::size_t parts = all_parts) {
    return parallel_reduce(
        distances.size(), DistanceSums{},
        [&](std::size_t begin, std::size_t end) {
            DistanceSums s;
            double last = unmeasured;
            MeasuredSamples::each_of(0, parts, begin, end, [&](std::size_t i) {
                const double square = distances[i] * distances[i];
                if (last != unmeasured) s.differences += (square - last) * (square - last);
                last = square;
                ++s.count;
                s.distances += distances[i];
                s.squares += square;
            });
            return s;
        },
        [](const DistanceSums& a, const DistanceSums& b) { return a.plus(b); });
}

void set_means(DirectedDeviation& d, const DistanceSums& sums) {
    d.averaged = sums.count;
    if (sums.count == 0) return;
    d.mean = std::min(sums.distances / static_cast<double>(sums.count), d.maximum);
    d.rms = std::min(sums.rms(), d.maximum);
}

void raise_maximum(DirectedDeviation& d, const Surface& from, const Farthest& farthest) {
    if (!(farthest.distance > d.maximum)) return;
    d.maximum = farthest.distance;
    d.from = farthest.from;
    d.to = farthest.to;
    d.face = farthest.triangle == none ? none : from.face(farthest.triangle);
}

/// Measures only the vertices of a surface without area, which has no samples.
void measure_vertices(DirectedDeviation& d, const Surface& from, const SampleWalk& walk, const FaceTree& to,
                      const DeviationSettings& settings) {
    const std::vector<Vec3> vertices = walk.vertices();
    const auto found = closest_points(to, vertices, OfSeveral::any);
    std::vector<double> distances(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        distances[i] = found[i].distance;
        raise_maximum(d, from, {vertices[i], found[i].point, found[i].distance});
    }
    if (settings.means) set_means(d, sums_of(distances));
}

/// The number of parts to measure next, if the error of `parts` is `times` the allowed error. Errors fall
/// with the square root, or faster, because neighbours come closer. So at most four times as many parts are
/// measured next.
std::size_t next_parts(std::size_t parts, double times) {
    const double enough = std::ceil(times * times * static_cast<double>(parts));
    const std::size_t most = std::min(4 * parts, all_parts);
    return enough < static_cast<double>(most) ? std::max(parts + 1, static_cast<std::size_t>(enough)) : most;
}

/// The means use as many samples as they need. The maximum is over all samples and vertices.
void measure_samples(DirectedDeviation& d, const Surface& from, const SampleWalk& walk,
                     MeasuredSamples& samples, const DeviationSettings& settings, std::vector<Index>& near) {
    ProgressSteps steps({2, 12, 2});
    raise_maximum(d, from,
                  walk.farthest_vertex(
                      0, near)); // first, because parts with a far smaller distance are then measured quickly
    steps.next();
    if (!settings.means) return raise_maximum(d, from, walk.farthest_sample(samples, d.maximum, near));
    DistanceSums sums;
    {
        ProgressRounds rounds;
        for (std::size_t parts = settings.mean_error > 0 ? all_parts / 9 : all_parts;;) {
            raise_maximum(d, from, walk.measure(samples, parts, d.maximum));
            sums = sums_of(samples.distances, parts);
            if (parts == all_parts || sums.error() <= settings.mean_error) break;
            parts = next_parts(parts, sums.error() / settings.mean_error);
            rounds.next();
        }
    }
    steps.next();
    if (sums.count < samples.points.size())
        raise_maximum(d, from, walk.farthest_sample(samples, d.maximum, near));
    set_means(d, sums);
}

/// Measures without the bound. order: the triangles, each near the previous. near: output, [vertices] a
/// triangle of the other surface's tree within the maximum of each vertex, or none; it may stay empty.
DirectedDeviation measured_to(const Surface& from, std::span<const Index> order, const FaceTree& to,
                              const DeviationSettings& settings, std::vector<Index>& near) {
    DirectedDeviation d;
    const SampleWalk walk(from, order, to);
    d.vertices = walk.vertex_count();
    if (d.vertices == 0) return d;
    if (to.empty()) {
        d.maximum = d.rms = d.mean = HUGE_VAL;
        return d;
    }
    ProgressSteps steps({1, 12});
    MeasuredSamples samples(from, order, settings.samples, settings.seed);
    d.samples = samples.points.size();
    steps.next();
    if (samples.points.size() == 0)
        measure_vertices(d, from, walk, to, settings);
    else
        measure_samples(d, from, walk, samples, settings, near);
    return d;
}

} // namespace

std::optional<double> DeviationResult::bound() const {
    if (!forward.bound || !backward.bound) return {};
    return std::max(*forward.bound, *backward.bound);
}

double DeviationResult::percent(double length) const {
    return length == 0 ? 0 : diagonal > 0 ? length / diagonal * 100 : HUGE_VAL;
}

DirectedDeviation deviation_to(const Surface& from, const FaceTree& to, const DeviationSettings& settings) {
    const auto corner = [&](std::size_t t) { return from.point(t, 0); };
    const Box dense = dense_box(from.size(), from.bounds(), corner);
    const std::vector<Index> order = order_along_curve(from.size(), dense, corner);
    ProgressSteps steps({1, settings.certify ? 2.0 : 0.0});
    std::vector<Index> near;
    DirectedDeviation d = measured_to(from, order, to, settings, near);
    steps.next();
    if (settings.certify) bound_deviation(d, from, order, to, near, d.maximum, settings);
    return d;
}

namespace {

/// The median length of the longest edges of about 64 triangles.
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

/// Whether most of about 64 points of a surface are farther from the other surface than the length of its
/// triangles. Each search starts at the previous result and stops when enough points are near.
bool is_far(const Surface& from, const Surface& to, const FaceTree& tree) {
    const double near = usual_length(to);
    const std::size_t step = from.size() / 64 + 1, points = (from.size() + step - 1) / step;
    std::size_t not_far = 0;
    Index hint = none;
    for (std::size_t t = 0; t < from.size(); t += step) {
        const Closest closest = closest_point(tree, from.point(t, 0), hint, near);
        if (closest.triangle != none) hint = closest.triangle;
        if (closest.distance <= near && 2 * ++not_far >= points) return false;
    }
    return points > 0;
}

/// Whether axis-aligned boxes are far larger than most of about 64 triangles, as for oblique slivers:
/// thousands of such boxes overlap.
bool are_askew(const Surface& surface) {
    constexpr double far_more =
        32; // ratio of the area of three box sides to the triangle's; at most 6 for even triangles
    std::size_t askew = 0, count = 0;
    for (std::size_t t = 0; t < surface.size(); t += surface.size() / 64 + 1, ++count) {
        const Vec3 &a = surface.point(t, 0), &b = surface.point(t, 1), &c = surface.point(t, 2);
        Box box;
        for (const Vec3& p : {a, b, c}) box.add(p);
        const Vec3 e = box.extent();
        const double sides = e.x * e.y + e.y * e.z + e.z * e.x, area = length(cross(b - a, c - a)) / 2;
        askew += sides > far_more * area ? 1 : 0;
    }
    return 2 * askew > count;
}

void flatten_if_useful(FaceTree& tree, const Surface& of, const Surface& from) {
    if (!tree.empty() && (are_askew(of) || is_far(from, of, tree))) tree.flatten();
}

/// The triangles in the order of their tree, followed by the triangles outside the tree.
std::vector<Index> order_of(const Surface& surface, const FaceTree& tree) {
    std::vector<Index> order = tree.sources;
    if (order.size() == surface.size()) return order;
    std::vector<std::uint8_t> known(surface.size());
    for (const Index t : order) known[t] = 1;
    for (std::size_t t = 0; t < known.size(); ++t)
        if (!known[t]) order.push_back(static_cast<Index>(t));
    return order;
}

/// The kind of tree for queries from another surface. A tree for fewer points than triangles is not worth
/// sorting fully. A bound may query many more points.
FaceTree::Use use_of_tree(const Surface& surface, const Surface& other, const DeviationSettings& settings) {
    const std::size_t points =
        settings.samples + other.positions.size() + (settings.certify ? settings.certify_work : 0);
    return points < surface.size() ? FaceTree::Use::few : FaceTree::Use::near;
}

Surface scaled(Surface surface, const PowerScale& scale) {
    surface.positions = scale(surface.positions);
    return surface;
}

/// Converts the result for scaled surfaces back to the original scale.
void unscale(DirectedDeviation& d, const PowerScale& scale) {
    for (double* x : {&d.maximum, &d.rms, &d.mean}) *x = unscaled(*x, scale.powers[0]);
    if (d.bound) d.bound = unscaled(*d.bound, scale.powers[0]);
    d.from = scale.inverse()(d.from);
    d.to = scale.inverse()(d.to);
}

} // namespace

DeviationResult deviation(const Surface& first, const Surface& second, const DeviationSettings& settings) {
    const Box of_first = first.bounds(), of_second = second.bounds();
    Box both = of_first;
    both.add(of_second);
    if (const PowerScale scale = even_scale(both); !scale.none()) {
        DeviationResult far = deviation(scaled(first, scale), scaled(second, scale), settings);
        unscale(far.forward, scale);
        unscale(far.backward, scale);
        far.diagonal = unscaled(far.diagonal, scale.powers[0]);
        return far;
    }
    DeviationResult result;
    result.seed = settings.seed;
    result.diagonal = diagonal(of_first);
    if (!settings.certify && are_same(first, second)) {
        result.forward = result.backward = deviation_from_itself(first, settings);
        return result;
    }
    ProgressSteps steps({1, 4, 4, settings.certify ? 8.0 : 0.0, settings.certify ? 8.0 : 0.0});
    FaceTree first_tree = FaceTree::over(first, of_first, use_of_tree(first, second, settings)),
             second_tree = FaceTree::over(second, of_second, use_of_tree(second, first, settings));
    const auto first_order = order_of(first, first_tree), second_order = order_of(second, second_tree);
    std::vector<Index> near_first, near_second; // [vertices] near triangles
    steps.next();
    flatten_if_useful(second_tree, second, first);
    result.forward = measured_to(first, first_order, second_tree, settings, near_first);
    steps.next();
    flatten_if_useful(first_tree, first, second);
    result.backward = measured_to(second, second_order, first_tree, settings, near_second);
    const bool one_empty = (result.forward.vertices == 0) != (result.backward.vertices == 0);
    if (one_empty)
        for (auto* d : {&result.forward, &result.backward}) d->maximum = d->rms = d->mean = HUGE_VAL;
    if (!settings.certify) return result;
    steps.next();
    bound_deviation(result.forward, first, first_order, second_tree, near_first, result.maximum(), settings);
    steps.next();
    bound_deviation(result.backward, second, second_order, first_tree, near_second, result.maximum(),
                    settings);
    for (auto* d : {&result.forward, &result.backward}) d->bound = std::max(*d->bound, result.maximum());
    return result;
}

DeviationResult deviation(const Mesh& first, const Mesh& second, const DeviationSettings& settings) {
    return deviation(filled_surface(first), filled_surface(second), settings);
}

} // namespace facetmill
