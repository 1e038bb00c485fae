#include "geometry/deviation/deviation.hpp"

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/random.hpp"
#include "geometry/deviation/bound.hpp"
#include "geometry/deviation/itself.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/dense_box.hpp"
#include "geometry/spatial/group_distances.hpp"
#include "geometry/spatial/hilbert_curve.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/power_scale.hpp"

#include <algorithm>
#include <array>

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

/// u and v: of Roberts' additive sequence in the plane, which fills large triangles more evenly than chance.
Vec3 sample_on(const Surface& surface, std::size_t triangle, double u, double v) {
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const Vec3& a = surface.point(triangle, 0);
    return a + (surface.point(triangle, 1) - a) * u + (surface.point(triangle, 2) - a) * v;
}

/// A distance that is not this many times its error is computed again, exactly, unless the error is this part
/// of the farthest so far.
constexpr double most_errors = 256, least_part = 1.0 / 16384;

/// The means are of so many ninths of the samples; more of them have all of fewer.
constexpr std::size_t all_ninths = 9;
constexpr std::size_t ninth_of(std::size_t sample) {
    // Evenly, as far as they go.
    constexpr std::array<std::uint8_t, all_ninths> turn{5, 2, 4, 7, 0, 6, 3, 8, 1};
    return turn[sample % all_ninths];
}
constexpr double unmeasured = -1;

struct Farthest {
    Vec3 from, to;
    double distance = -1;
    std::size_t sample = SIZE_MAX; ///< its number, unless it is a vertex
};

Farthest farther_of(const Farthest& a, const Farthest& b) { return b.distance > a.distance ? b : a; }

/// Which triangle, of those that use it, is the first; none for vertices that are not finite.
std::vector<Index> first_uses(const Surface& surface) {
    std::vector<Index> first(surface.positions.size(), none);
    for (std::size_t c = surface.corners.size(); c-- > 0;)
        first[surface.corners[c]] = static_cast<Index>(c / 3);
    parallel_for(first.size(), [&](std::size_t v) {
        if (!is_finite(surface.positions[v])) first[v] = none;
    });
    return first;
}

/// Points of a surface and their distances to another, as far as they are measured.
struct Samples {
    std::vector<SurfaceSample> points;
    std::vector<double> distances;
    std::vector<std::size_t> firsts; ///< [triangles + 1] the first of each; they are in the triangles' order

    Samples(const Surface& surface, const DeviationSettings& settings)
        : points(sample_area(surface, settings.samples, settings.seed)), distances(points.size(), unmeasured),
          firsts(surface.size() + 1) {
        for (const SurfaceSample& s : points) ++firsts[s.triangle];
        exclusive_scan(firsts);
    }

    /// Whether a sample of the triangle that is not measured may be farther than all so far: few of the
    /// others are, or one of them comes to half of that.
    bool may_exceed(double most, std::size_t t) const {
        constexpr std::size_t enough = 8;
        std::size_t known = 0;
        double farthest = 0;
        for (std::size_t i = firsts[t]; i < firsts[t + 1]; ++i) {
            known += distances[i] != unmeasured;
            farthest = std::max(farthest, distances[i]);
        }
        return known < enough || farthest >= most / 2;
    }
};

/// Whether to try again what may be in vain: then fewer and fewer of up to 32 are.
class Attempts {
  public:
    bool next() {
        if (left_out_ == 0) return true;
        --left_out_;
        return false;
    }
    void note(bool success) {
        constexpr std::size_t most_often = 5;
        in_vain_ = success ? 0 : std::min(in_vain_ + 1, most_often);
        left_out_ = (std::size_t{1} << in_vain_) - 1;
    }

  private:
    std::size_t in_vain_ = 0, left_out_ = 0;
};

/// Measures one way, the triangles in an order in which each is near the one before.
class Walk {
  public:
    Walk(const Surface& from, std::span<const Index> order, const FaceTree& to)
        : from_(from), order_(order), to_(to), first_uses_(first_uses(from)) {}

    std::size_t vertex_count() const {
        return first_uses_.size() -
               static_cast<std::size_t>(std::count(first_uses_.begin(), first_uses_.end(), none));
    }
    std::vector<Vec3> vertices() const {
        std::vector<Vec3> points;
        for (std::size_t v = 0; v < first_uses_.size(); ++v)
            if (first_uses_[v] != none) points.push_back(from_.positions[v]);
        return points;
    }

    /// The farthest vertex, when it is beyond `least`. One that turns out nearer than one before it need not
    /// be searched to the end.
    Farthest farthest_vertex(double least) const {
        return farthest(least, 4096, [&](Index t, Candidates& waiting) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index v = from_.corners[3 * std::size_t{t} + k];
                if (first_uses_[v] == t) waiting.add(from_.positions[v], SIZE_MAX);
            }
        });
    }

    /// The farthest of the samples that have not been measured, likewise; but for those of triangles where
    /// the others stay well below it.
    Farthest farthest_sample(const Samples& samples, double least) const {
        return farthest(least, samples_chunk(), [&](Index t, Candidates& waiting) {
            if (samples.may_exceed(least, t)) waiting.add_unmeasured(samples, t);
        });
    }

    /// Measures so many ninths of the samples, but for those that are; returns the farthest of them.
    Farthest measure(Samples& samples, std::size_t ninths) const {
        Share::loop_tells();
        return parallel_reduce(
            order_.size(), Farthest{},
            [&](std::size_t begin, std::size_t end) {
                Groups groups{*this, samples.points, samples.distances, GroupDistances(to_), {{}, {}, 0}};
                for (std::size_t i = begin; i < end; ++i)
                    groups.add(samples.firsts[order_[i]], samples.firsts[order_[i] + std::size_t{1}], ninths);
                groups.finish();
                return groups.best;
            },
            farther_of, samples_chunk());
    }

  private:
    struct Candidates;
    std::size_t samples_chunk() const { return std::clamp<std::size_t>(order_.size() / 64, 1, 4096); }

    /// Raises `best` if p is farther. The coordinates of samples are rounded, those of vertices are not.
    void consider(const Vec3& p, std::size_t sample, Index& hint, Farthest& best) const {
        const double none_below = sample == SIZE_MAX ? 0 : distance_of_none(p);
        const Closest c = closest_point(to_, p, hint, std::max(best.distance, none_below));
        hint = c.triangle;
        const double distance = c.distance <= none_below ? 0 : c.distance;
        if (distance > best.distance) best = {p, c.point, distance, sample};
    }

    /// Points that wait to be compared with the farthest together.
    struct Candidates {
        const Walk& walk;
        GroupDistances together;
        Farthest best;
        std::vector<Vec3> points{};
        std::vector<std::size_t> samples{}; ///< their numbers, SIZE_MAX for vertices
        Index hint = none;
        Attempts attempts{};

        void add(const Vec3& p, std::size_t sample) {
            points.push_back(p);
            samples.push_back(sample);
            if (points.size() == GroupDistances::most) finish();
        }

        void add_unmeasured(const Samples& samples, std::size_t t) {
            for (std::size_t i = samples.firsts[t]; i < samples.firsts[t + 1]; ++i)
                if (samples.distances[i] == unmeasured) add(samples.points[i].point, i);
        }

        void finish() {
            if (!points.empty() && !all_within())
                for (std::size_t i = 0; i < points.size(); ++i)
                    if (together.distance(i) + together.error() > best.distance)
                        walk.consider(points[i], samples[i], hint, best);
            points.clear();
            samples.clear();
        }

        bool all_within() {
            if (!attempts.next()) {
                together.forget();
                return false;
            }
            const bool all = together.all_within(points, best.distance, hint);
            attempts.note(!together.too_many());
            return all;
        }
    };

    /// The farthest of what add(triangle, candidates) adds for each triangle, in chunks of so many.
    template <class Add>
    Farthest farthest(double least, std::size_t chunk, const Add& add) const {
        Share::loop_tells();
        return parallel_reduce(
            order_.size(), Farthest{},
            [&](std::size_t begin, std::size_t end) {
                Candidates waiting{*this, GroupDistances(to_), {{}, {}, least}};
                for (std::size_t i = begin; i < end; ++i) add(order_[i], waiting);
                waiting.finish();
                return waiting.best;
            },
            farther_of, chunk);
    }

    /// Samples that wait to be measured together. Only those that may be the farthest are looked up.
    struct Groups {
        const Walk& walk;
        const std::vector<SurfaceSample>& samples;
        std::vector<double>& distances;
        GroupDistances together;
        Farthest best;
        std::vector<Index> waiting{};
        std::vector<Vec3> points{};
        Index hint = none;
        Attempts attempts{};

        void add(std::size_t begin, std::size_t end, std::size_t ninths) {
            for (std::size_t i = begin; i < end; ++i)
                if (ninth_of(i) < ninths && distances[i] == unmeasured)
                    waiting.push_back(static_cast<Index>(i));
            if (waiting.size() >= GroupDistances::most / 2) finish();
        }

        void finish() {
            if (!waiting.empty()) measure(waiting);
            waiting.clear();
        }

        /// Halved across the middle of the longest side until they are few enough.
        void measure(std::span<Index> some) {
            if (some.size() <= GroupDistances::most) return measure_group(some);
            Box box;
            for (const Index i : some) box.add(samples[i].point);
            const Vec3 sides = box.extent();
            const std::size_t axis = sides.x >= sides.y && sides.x >= sides.z ? 0
                                     : sides.y >= sides.z                     ? 1
                                                                              : 2;
            const double middle = box.centre()[axis];
            const auto upper = std::partition(some.begin(), some.end(),
                                              [&](Index i) { return samples[i].point[axis] < middle; });
            auto half = static_cast<std::size_t>(upper - some.begin());
            if (half == 0 || half == some.size()) half = some.size() / 2; // all in one place
            measure(some.first(half));
            measure(some.subspan(half));
        }

        void measure_group(std::span<const Index> some) {
            if (!measures_together(some)) {
                for (const Index i : some) measure_alone(i, hint);
                return;
            }
            for (std::size_t k = 0; k < some.size(); ++k) {
                const double distance = together.distance(k);
                if (together.error() > std::max(distance / most_errors, best.distance * least_part)) {
                    measure_alone(some[k], together.triangle(k));
                    continue;
                }
                distances[some[k]] = told_from_zero(distance, points[k]);
                Index near = together.triangle(k);
                if (distance + together.error() > best.distance)
                    walk.consider(points[k], some[k], near, best);
            }
        }

        bool measures_together(std::span<const Index> some) {
            if (!attempts.next()) return false;
            points.clear();
            for (const Index i : some) points.push_back(samples[i].point);
            const bool measured = together.measure(points, hint);
            attempts.note(measured);
            return measured;
        }

        /// Exactly.
        void measure_alone(Index i, Index near) {
            const Vec3& p = samples[i].point;
            Closest c;
            if (near != none) c = closest_on(walk.to_, near, p);
            if (told_from_zero(c.distance, p) > 0) c = closest_point(walk.to_, p, near);
            hint = c.triangle;
            distances[i] = told_from_zero(c.distance, p);
            if (distances[i] > best.distance) best = {p, c.point, distances[i], i};
        }
    };

    const Surface& from_;
    std::span<const Index> order_;
    const FaceTree& to_;
    std::vector<Index> first_uses_;
};

/// Of the distances that were measured.
struct DistanceSums {
    std::size_t count = 0;
    double distances = 0, squares = 0, differences = 0; ///< the last between squares of neighbours, squared

    DistanceSums plus(const DistanceSums& b) const {
        return {count + b.count, distances + b.distances, squares + b.squares, differences + b.differences};
    }
    double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
    /// The standard error of the RMS, as a part of it; infinity when that is 0. Samples lie in equal parts of
    /// the area one after the other, so what neighbours differ by is what chance adds. After W. G. Cochran,
    /// "Sampling Techniques" (1977), 8.11.
    double error() const { return squares > 0 ? std::sqrt(differences / 2) / squares / 2 : HUGE_VAL; }
};

DistanceSums sums_of(const std::vector<double>& distances) {
    return parallel_reduce(
        distances.size(), DistanceSums{},
        [&](std::size_t begin, std::size_t end) {
            DistanceSums s;
            double last = unmeasured;
            for (std::size_t i = begin; i < end; ++i) {
                if (distances[i] == unmeasured) continue;
                const double square = distances[i] * distances[i];
                if (last != unmeasured) s.differences += (square - last) * (square - last);
                last = square;
                ++s.count;
                s.distances += distances[i];
                s.squares += square;
            }
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

void set_maximum(DirectedDeviation& d, const Farthest& farthest, Index face) {
    if (!(farthest.distance > d.maximum)) return;
    d.maximum = farthest.distance;
    d.from = farthest.from;
    d.to = farthest.to;
    d.face = face;
}

/// Of a surface without an area: the distances of its vertices, which are all that there is.
void measure_vertices(DirectedDeviation& d, const std::vector<Vec3>& vertices, const FaceTree& to) {
    const auto found = closest_points(to, vertices);
    std::vector<double> distances(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        distances[i] = found[i].distance;
        set_maximum(d, {vertices[i], found[i].point, found[i].distance}, none);
    }
    set_means(d, sums_of(distances));
}

/// Of samples of which one ninth has so many times the error that is wanted: how many are enough. Errors fall
/// with the root, or faster, as neighbours come closer: a third may do where that says four ninths.
std::size_t ninths_for(double times) {
    constexpr std::size_t third = all_ninths / 3;
    if (times * times <= 2) return 2;
    if (times <= 2) return third;
    for (std::size_t ninths = third + 2; ninths < all_ninths; ++ninths)
        if (times * times <= static_cast<double>(ninths)) return ninths;
    return all_ninths;
}

/// The means are of as many samples as they need; the maximum is the farthest of all, and of the vertices.
void measure_samples(DirectedDeviation& d, const Surface& from, const Walk& walk, Samples& samples,
                     const DeviationSettings& settings) {
    const auto raise = [&](const Farthest& farthest) {
        const bool of_face = farthest.sample != SIZE_MAX;
        set_maximum(d, farthest, of_face ? from.face(samples.points[farthest.sample].triangle) : none);
    };
    ShareOfSteps steps({1, 2, 2, 6, 2, 2});
    DistanceSums sums;
    bool will_do = false;
    const auto measure = [&](bool needed, std::size_t ninths) {
        if (needed) {
            raise(walk.measure(samples, ninths));
            sums = sums_of(samples.distances);
            will_do = sums.error() <= settings.mean_error;
        }
        steps.next();
    };
    measure(settings.mean_error > 0, 1);
    constexpr std::size_t third = all_ninths / 3;
    const std::size_t enough = ninths_for(sums.error() / settings.mean_error);
    measure(!will_do && enough < all_ninths, enough);
    measure(!will_do && enough < third, third);
    measure(!will_do, all_ninths);
    raise(walk.farthest_vertex(d.maximum));
    steps.next();
    if (sums.count < samples.points.size()) raise(walk.farthest_sample(samples, d.maximum));
    set_means(d, sums);
}

/// order: the triangles, each near the one before.
DirectedDeviation deviation_to(const Surface& from, std::span<const Index> order, const FaceTree& to,
                               const DeviationSettings& settings) {
    DirectedDeviation d;
    const Walk walk(from, order, to);
    d.vertices = walk.vertex_count();
    if (d.vertices == 0) {
        if (settings.certify) d.bound = 0;
        return d;
    }
    if (to.empty()) {
        d.maximum = d.rms = d.mean = HUGE_VAL;
        if (settings.certify) d.bound = HUGE_VAL;
        return d;
    }
    ShareOfSteps steps({1, 12, settings.certify ? 26.0 : 0.0});
    Samples samples(from, settings);
    d.samples = samples.points.size();
    steps.next();
    if (samples.points.empty())
        measure_vertices(d, walk.vertices(), to);
    else
        measure_samples(d, from, walk, samples, settings);
    steps.next();
    if (settings.certify) bound_deviation(d, from, order, to, settings);
    return d;
}

} // namespace

std::vector<SurfaceSample> sample_area(const Surface& surface, std::size_t count, std::uint64_t seed) {
    const std::vector<double> areas = areas_up_to(surface);
    if (areas.empty() || !(areas.back() > 0) || !std::isfinite(areas.back())) return {};
    std::vector<SurfaceSample> samples(count);
    const auto start = [&](std::uint64_t i) { return uniform(hashed(seed, i)); };
    const double start_u = start(0), start_v = start(1);
    const auto at = [&](std::size_t k) {
        return (static_cast<double>(k) + start(k + 2)) / static_cast<double>(count) * areas.back();
    };
    parallel_chunks(count, [&](std::size_t begin, std::size_t end) {
        auto t =
            static_cast<std::size_t>(std::upper_bound(areas.begin(), areas.end(), at(begin)) - areas.begin());
        for (std::size_t k = begin; k < end; ++k) {
            // The last triangle when rounding leads past the end; it need not have an area, which does no
            // harm.
            for (const double here = at(k); t < areas.size() && areas[t] <= here;) ++t;
            t = std::min(t, areas.size() - 1);
            samples[k] = {sample_on(surface, t,
                                    fraction(start_u + static_cast<double>(k) * 0.7548776662466927),
                                    fraction(start_v + static_cast<double>(k) * 0.5698402909980532)),
                          static_cast<Index>(t)};
        }
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
    const auto corner = [&](std::size_t t) { return from.point(t, 0); };
    const Box dense = dense_box(from.size(), from.bounds(), corner);
    return deviation_to(from, order_along_curve(from.size(), dense, corner), to, settings);
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

/// Whether most of about 64 points of a surface are farther from another than its triangles are long. They
/// are looked up from the triangle that the one before was near, until those that are near are enough.
bool is_far(const Surface& from, const Surface& to, const FaceTree& tree) {
    if (tree.empty()) return false;
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

/// The triangles in the order of their tree, and those that are in none.
std::vector<Index> order_of(const Surface& surface, const FaceTree& tree) {
    std::vector<Index> order = tree.sources;
    if (order.size() == surface.size()) return order;
    std::vector<std::uint8_t> known(surface.size());
    for (const Index t : order) known[t] = 1;
    for (std::size_t t = 0; t < known.size(); ++t)
        if (!known[t]) order.push_back(static_cast<Index>(t));
    return order;
}

DirectedDeviation deviation_between(const Surface& from, std::span<const Index> order, const Surface& to,
                                    FaceTree& tree, const DeviationSettings& settings) {
    if (is_far(from, to, tree)) tree.flatten();
    return deviation_to(from, order, tree, settings);
}

/// Of a tree that is to be asked for points of another surface: where they are fewer than its triangles, it
/// is not worth sorting as well as it can be. A bound asks for more.
FaceTree::Use use_of_tree(const Surface& surface, const Surface& other, const DeviationSettings& settings) {
    const std::size_t points = settings.samples + other.positions.size();
    return !settings.certify && points < surface.size() ? FaceTree::Use::few : FaceTree::Use::near;
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
    ShareOfSteps steps({1, 4, 4});
    FaceTree first_tree = FaceTree::over(first, of_first, use_of_tree(first, second, settings)),
             second_tree = FaceTree::over(second, of_second, use_of_tree(second, first, settings));
    const auto first_order = order_of(first, first_tree), second_order = order_of(second, second_tree);
    steps.next();
    result.forward = deviation_between(first, first_order, second, second_tree, settings);
    steps.next();
    result.backward = deviation_between(second, second_order, first, first_tree, settings);
    const bool one_empty = (result.forward.vertices == 0) != (result.backward.vertices == 0);
    if (one_empty)
        for (auto* d : {&result.forward, &result.backward}) d->maximum = d->rms = d->mean = HUGE_VAL;
    return result;
}

DeviationResult deviation(const Mesh& first, const Mesh& second, const DeviationSettings& settings) {
    return deviation(filled_surface(first), filled_surface(second), settings);
}

} // namespace facetmill
