#include "base/progress.hpp"
#include "geometry/deviation/bound.hpp"
#include "geometry/deviation/sample_groups.hpp"
#include "geometry/deviation/sample_walk.hpp"
#include "geometry/spatial/group_distances.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <bit>

namespace facetmill {

/// The last few points with known distances, and the triangles near them.
class SampleWalk::Known {
  public:
    static constexpr std::size_t few = 8;

    void add(const Vec3& point, double distance, Index triangle) {
        Item& item = items_[next_];
        next_ = (next_ + 1) % items_.size();
        item = {point, distance, triangle};
    }
    /// Sets `near` to the triangle of the nearest known point, if any. Returns whether a known point proves
    /// that p is within `distance`, by the triangle inequality.
    bool show_within(const Vec3& p, double distance, Index& near) const {
        double least = HUGE_VAL;
        for (const Item& item : items_) {
            const Vec3 off = p - item.point;
            const double square = dot(off, off), left = distance - item.distance;
            if (left > 0 && square < left * left * (1 - 1e-9)) return true;
            if (!(square < least) || item.triangle == none) continue;
            least = square;
            near = item.triangle;
        }
        return false;
    }

  private:
    struct Item {
        Vec3 point;
        double distance = HUGE_VAL;
        Index triangle = none;
    };
    std::array<Item, few> items_{};
    std::size_t next_ = 0;
};

/// Raises `best` if p is farther. Returns a point that is near enough, or the closest. The coordinates of
/// samples are rounded, coordinates of vertices are not.
Closest SampleWalk::consider(const Vec3& p, Index triangle, Index hint, Farthest& best) const {
    const double none_below = triangle == none ? 0 : distance_of_none(p);
    const Closest c = closest_point(to_, p, hint, std::max(best.distance, none_below));
    const double distance = c.distance <= none_below ? 0 : c.distance;
    if (distance > best.distance) best = {p, c.point, distance, triangle};
    return c;
}

/// Points that wait for a joint comparison with the farthest.
struct SampleWalk::Candidates {
    struct Waiting {
        Vec3 point;
        Index triangle; ///< the triangle of a sample, none for vertices
        Index near;     ///< a triangle of the other surface, if one is known
        Index vertex;   ///< the vertex, none for samples
    };

    const SampleWalk& walk;
    GroupDistances together;
    Farthest best;
    std::vector<Waiting> waiting{};
    std::vector<Vec3> points{};
    Index hint = none;
    std::span<Index> found{}; ///< [vertices] output: a triangle within the farthest distance of each vertex
    std::span<const Index> near_corner{}; ///< [vertices] the same, as input
    Attempts attempts{}, corner_attempts{}, across_attempts{};
    static constexpr std::size_t fewest = 8; ///< the smallest group worth comparing together
    std::size_t size = GroupDistances::most; ///< the largest group
    Known known{};
    double rounding = 0; ///< rounding of samples on triangles at the group's vertices

    void add_vertex(Index v) {
        waiting.push_back({walk.from_.positions[v], none, none, v});
        if (waiting.size() == GroupDistances::most) finish();
    }

    void add_unmeasured(const MeasuredSamples& samples, const AreaSamples::Run& run) {
        constexpr std::size_t many =
            16; // above this, single tests cost more than a group test or a test of the corners
        const Index t = run.triangle;
        const bool together = run.end - run.begin >= many;
        if (have_same_near(t)) return;
        if (samples.parts > 0) add_known(samples, run);
        if (together && is_within(t)) return;
        const AreaSamples::OnTriangle on = samples.points.on(t);
        MeasuredSamples::each_of(samples.parts, MeasuredSamples::all_parts, run.begin, run.end,
                                 [&](std::size_t i) { add_sample(on.point(i), t, together); });
        if (waiting.size() >= GroupDistances::most / 2) finish();
    }

    void add_known(const MeasuredSamples& samples, const AreaSamples::Run& run) {
        std::size_t left = Known::few;
        for (std::size_t i = run.end; i > run.begin && left > 0;) {
            if (samples.distances[--i] == MeasuredSamples::unmeasured) continue;
            known.add(samples.points.point(i), at_most(samples.distances[i]), samples.nearest[i]);
            --left;
        }
    }

    /// Whether the corners of a triangle, and so all of it, are within the farthest distance of a single
    /// triangle.
    bool is_within(Index t) const {
        const Vec3 &a = walk.from_.point(t, 0), &b = walk.from_.point(t, 1), &c = walk.from_.point(t, 2);
        Index near = none;
        known.show_within((a + b + c) / 3, -1, near);
        const auto is_near = [&](const Vec3& corner) { // accounts for rounded samples
            return closest_on(walk.to_, near, corner).distance <= best.distance - distance_of_none(corner);
        };
        return near != none && is_near(a) && is_near(b) && is_near(c);
    }

    /// Whether the corners are within the farthest distance of the same triangle; then all samples between
    /// them are too.
    bool have_same_near(Index t) const {
        if (near_corner.empty()) return false;
        const Index* const corners = &walk.from_.corners[3 * std::size_t{t}];
        const Index near = near_corner[corners[0]];
        return near != none && near == near_corner[corners[1]] && near == near_corner[corners[2]];
    }

    void add_sample(const Vec3& p, Index t, bool together) {
        Index near = none;
        if (!together && is_near_corners(p, t)) return;
        if (known.show_within(p, best.distance, near)) return;
        if (together || near == none || !(closest_on(walk.to_, near, p).distance <= best.distance))
            waiting.push_back({p, t, near, none});
    }

    /// Whether a triangle near a corner of the sample's triangle proves that the sample is within the
    /// farthest distance.
    bool is_near_corners(const Vec3& p, Index t) {
        if (near_corner.empty() || !corner_attempts.next()) return false;
        Index tried = none;
        bool is_near = false;
        for (std::size_t k = 0; k < 3 && !is_near; ++k) {
            const Index near = near_corner[walk.from_.corners[3 * std::size_t{t} + k]];
            if (near == none || near == tried) continue;
            tried = near;
            is_near = closest_on(walk.to_, near, p).distance <= best.distance;
        }
        corner_attempts.note(is_near);
        return is_near;
    }

    /// An upper bound of a measured distance, because the measurement has an error.
    double at_most(double distance) const {
        return distance + std::max(distance / (MeasuredSamples::most_errors - 1),
                                   best.distance * MeasuredSamples::least_part);
    }

    void finish() {
        if (!waiting.empty()) compare(waiting);
        waiting.clear();
    }

    void compare(std::span<Waiting> some) {
        if (some.size() <= size) return compare_group(some);
        const std::size_t half = halved(some);
        compare(some.first(half));
        compare(some.subspan(half));
    }

    /// Looks up, one at a time, the points not yet known to be within the farthest distance. The closest
    /// triangle of each point is tried for the other points.
    void compare_group(std::span<Waiting> some) {
        points.clear();
        for (const Waiting& w : some) points.push_back(w.point);
        std::uint32_t left = ~std::uint32_t{0} >> (GroupDistances::most - some.size());
        rounding = 0;
        if (!found.empty())
            for (const Vec3& p : points) rounding = std::max(rounding, distance_of_none(p));
        double laid_out = 0;
        if (some[0].near != none) hint = some[0].near;
        if (hint != none) leave_out(within(left, laid_out), some, left);
        if (!leave_out_across(some, left, laid_out) && some.size() > fewest) {
            size = std::max(fewest, some.size() / 2);
            return compare(those_of(left, some));
        }
        while (left != 0) {
            const Waiting& w = some[static_cast<std::size_t>(std::countr_zero(left))];
            const Closest c = walk.consider(w.point, w.triangle, w.near == none ? hint : w.near, best);
            hint = c.triangle;
            known.add(w.point, c.distance, c.triangle);
            left &= left - 1;
            if (!found.empty() && c.distance <= within_what()) found[w.vertex] = c.triangle;
            leave_out(within(left, laid_out), some, left);
        }
    }

    /// Skipped points are proved to be within this distance. For vertices it is less than the farthest by
    /// the possible rounding of samples between them.
    double within_what() const { return best.distance - rounding; }

    /// Moves the points of these bits to the front.
    static std::span<Waiting> those_of(std::uint32_t those, std::span<Waiting> some) {
        std::size_t count = 0;
        for (; those != 0; those &= those - 1)
            std::swap(some[count++], some[static_cast<std::size_t>(std::countr_zero(those))]);
        return some.first(count);
    }

    /// Finds the points that project into a triangle within the farthest distance. Returns false if fewer
    /// points should be tried together.
    bool leave_out_across(std::span<const Waiting> some, std::uint32_t& left, double& laid_out) {
        constexpr int enough = 4; // with fewer points, single tests are as fast
        if (std::popcount(left) < enough || best.distance == 0) return true;
        if (some.size() <= fewest && !across_attempts.next()) return true;
        if (laid_out == 0 && together.lay_out(points, within_what())) laid_out = within_what();
        if (laid_out == 0) return true;
        std::uint32_t others = left;
        const bool tried = together.take_across(points, laid_out, others, [&](std::size_t i, Index triangle) {
            hint = triangle;
            leave_out(std::uint32_t{1} << i, some, left);
        });
        if (some.size() <= fewest) across_attempts.note(tried);
        if (tried && 2 * some.size() > size) size = std::min(2 * size, GroupDistances::most);
        return tried;
    }

    /// Skips the points near the triangle `hint`.
    void leave_out(std::uint32_t those, std::span<const Waiting> some, std::uint32_t& left) {
        left &= ~those;
        if (found.empty()) return;
        for (; those != 0; those &= those - 1)
            found[some[static_cast<std::size_t>(std::countr_zero(those))].vertex] = hint;
    }

    /// The points within the farthest distance of the triangle `hint`, as far as tried.
    std::uint32_t within(std::uint32_t left, double& laid_out) {
        if (left == 0 || !attempts.next()) return 0;
        if (laid_out < within_what()) laid_out = together.lay_out(points, within_what()) ? within_what() : 0;
        const std::uint32_t near = laid_out > 0 ? together.within(points, hint, left) & left : 0;
        attempts.note(near != 0);
        return near;
    }
};

/// The farthest point of all that add(i, candidates) adds for i below count, in chunks of the given size.
template <class Add>
Farthest SampleWalk::farthest(std::size_t count, double least, std::size_t chunk, const Add& add) const {
    ProgressScope::report_next_loop();
    return parallel_reduce(
        count, Farthest{},
        [&](std::size_t begin, std::size_t end) {
            Candidates candidates{*this, GroupDistances(to_), {{}, {}, least}};
            for (std::size_t i = begin; i < end; ++i) add(i, candidates);
            candidates.finish();
            return candidates.best;
        },
        farther_of, chunk);
}

Farthest SampleWalk::farthest_vertex(double least, std::vector<Index>& near) const {
    near.assign(from_.positions.size(), none);
    return farthest(order_.size(), least, 4096, [&](std::size_t i, Candidates& candidates) {
        const Index t = order_[i];
        candidates.found = near;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = from_.corners[3 * std::size_t{t} + k];
            if (first_uses_[v] == t) candidates.add_vertex(v);
        }
    });
}

Farthest SampleWalk::farthest_sample(const MeasuredSamples& samples, double least,
                                     std::span<const Index> near) const {
    return farthest(samples.runs.size(), least, samples.chunk(), [&](std::size_t i, Candidates& candidates) {
        candidates.near_corner = near;
        candidates.add_unmeasured(samples, samples.runs[i]);
    });
}

} // namespace facetmill
