#include "geometry/deviation/sample_walk.hpp"

#include "base/progress.hpp"
#include "geometry/deviation/bound.hpp"
#include "geometry/deviation/sample_groups.hpp"
#include "geometry/spatial/group_distances.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

/// The part of each of 18 consecutive samples has the digits of the sample's number in bases 2, 3 and 3 in
/// reverse. So several parts are spread evenly. After J. G. van der Corput, "Verteilungsfunktionen" (1935).
/// For each part, stores bits for the samples of earlier parts.
constexpr auto rows_before_parts() {
    std::array<std::uint32_t, MeasuredSamples::all_parts + 1> rows{};
    for (std::size_t part = 0; part < MeasuredSamples::all_parts; ++part) {
        const std::size_t at = part % 2 * 9 + part / 2 % 3 * 3 + part / 6;
        rows[part + 1] = rows[part] | std::uint32_t{1} << at;
    }
    return rows;
}

/// The first triangle that uses each vertex; none for vertices that are not finite.
std::vector<Index> first_uses(const Surface& surface) {
    std::vector<Index> first(surface.positions.size(), none);
    for (std::size_t c = surface.corners.size(); c-- > 0;)
        first[surface.corners[c]] = static_cast<Index>(c / 3);
    parallel_for(first.size(), [&](std::size_t v) {
        if (!is_finite(surface.positions[v])) first[v] = none;
    });
    return first;
}

} // namespace

std::uint32_t MeasuredSamples::row_before(std::size_t part) {
    static constexpr auto rows = rows_before_parts();
    return rows[part];
}

SampleWalk::SampleWalk(const Surface& from, std::span<const Index> order, const FaceTree& to)
    : from_(from), order_(order), to_(to), first_uses_(first_uses(from)) {}

std::size_t SampleWalk::vertex_count() const {
    return first_uses_.size() -
           static_cast<std::size_t>(std::count(first_uses_.begin(), first_uses_.end(), none));
}

std::vector<Vec3> SampleWalk::vertices() const {
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < first_uses_.size(); ++v)
        if (first_uses_[v] != none) points.push_back(from_.positions[v]);
    return points;
}

std::size_t MeasuredSamples::chunk() const { return std::clamp<std::size_t>(runs.size() / 64, 1, 4096); }

/// Samples that wait to be measured together. Only samples that may be the farthest are looked up.
struct SampleWalk::Groups {
    struct Waiting {
        Vec3 point;
        std::size_t sample;
        Index triangle;
    };

    const SampleWalk& walk;
    MeasuredSamples& samples;
    GroupDistances together;
    Farthest best;
    std::vector<Waiting> waiting{};
    std::vector<Vec3> points{};
    Index hint = none;
    static constexpr std::size_t fewest = 8;
    std::size_t size = GroupDistances::most; ///< up to this many are tried together
    Attempts attempts{};

    /// Adds the unmeasured samples of a triangle that belong to earlier parts.
    void add(const AreaSamples::Run& run, std::size_t parts) {
        const AreaSamples::OnTriangle on = samples.points.on(run.triangle);
        MeasuredSamples::each_of(samples.parts, parts, run.begin, run.end, [&](std::size_t i) {
            waiting.push_back({on.point(i), i, run.triangle});
        });
        if (waiting.size() >= GroupDistances::most / 2) finish();
    }

    void finish() {
        if (!waiting.empty()) measure(waiting);
        waiting.clear();
    }

    /// Halves the samples across the middle of their longest side until they can be measured together. If
    /// the other surface has many triangles, groups are smaller.
    void measure(std::span<Waiting> some) {
        if (some.size() <= size) {
            if (measure_group(some)) return;
            if (some.size() <= fewest) {
                for (const Waiting& w : some) measure_alone(w, hint);
                return;
            }
            size = std::max(fewest, some.size() / 2);
        }
        const std::size_t half = halved(some);
        measure(some.first(half));
        measure(some.subspan(half));
    }

    /// Returns false if each sample must be measured separately.
    bool measure_group(std::span<const Waiting> some) {
        if (!measures_together(some)) return false;
        for (std::size_t k = 0; k < some.size(); ++k) {
            const double distance = together.distance(k);
            const double allowed = std::max(distance / MeasuredSamples::most_errors,
                                            best.distance * MeasuredSamples::least_part);
            if (together.error() > allowed) {
                const Index near = together.triangle(k);
                together.is_certain(k) ? take(some[k], closest_on(walk.to_, near, some[k].point))
                                       : measure_alone(some[k], near);
                continue;
            }
            samples.distances[some[k].sample] = told_from_zero(distance, some[k].point);
            samples.nearest[some[k].sample] = together.triangle(k);
            if (distance + together.error() > best.distance)
                walk.consider(some[k].point, some[k].triangle, together.triangle(k), best);
        }
        return true;
    }

    bool measures_together(std::span<const Waiting> some) {
        if (some.size() < 2 || (some.size() <= fewest && !attempts.next())) return false;
        points.clear();
        for (const Waiting& w : some) points.push_back(w.point);
        const bool measured = together.measure(points, hint);
        if (some.size() <= fewest) attempts.note(measured);
        if (measured && 2 * some.size() > size) size = std::min(2 * size, GroupDistances::most);
        return measured;
    }

    /// Measures a sample exactly.
    void measure_alone(const Waiting& w, Index near) {
        Closest c;
        if (near != none) c = closest_on(walk.to_, near, w.point);
        if (told_from_zero(c.distance, w.point) > 0) c = closest_point(walk.to_, w.point, near);
        hint = c.triangle;
        take(w, c);
    }

    void take(const Waiting& w, const Closest& c) {
        const double distance = told_from_zero(c.distance, w.point);
        samples.distances[w.sample] = distance;
        samples.nearest[w.sample] = c.triangle;
        if (distance > best.distance) best = {w.point, c.point, distance, w.triangle};
    }
};

Farthest SampleWalk::measure(MeasuredSamples& samples, std::size_t parts, double least) const {
    ProgressScope::report_next_loop();
    const Farthest farthest = parallel_reduce(
        samples.runs.size(), Farthest{},
        [&](std::size_t begin, std::size_t end) {
            Groups groups{*this, samples, GroupDistances(to_), {{}, {}, least}};
            for (std::size_t i = begin; i < end; ++i) groups.add(samples.runs[i], parts);
            groups.finish();
            return groups.best;
        },
        farther_of, samples.chunk());
    samples.parts = std::max(samples.parts, parts);
    return farthest;
}

} // namespace facetmill
