#include "geometry/probe/probe.hpp"

#include "base/progress.hpp"
#include "geometry/spatial/hilbert_curve.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Queries points that are near each other in sequence.
class Walk {
  public:
    Walk(const FaceTree& tree, const PointSettings& settings) : tree_(tree), settings_(settings) {}

    PointAnswer next(const Vec3& p) {
        PointAnswer a;
        a.closest = closest_point(tree_, p, hint_);
        if (a.closest.face == none) { // no surface, or an invalid point
            a.side = settings_.closed && is_finite(p) ? Side::outside : Side::unknown;
            return a;
        }
        hint_ = a.closest.triangle;
        // The distance of a point on the surface is at most this large, because of rounding.
        const double near = 1e-12 / tree_.scale;
        if (a.closest.distance <= settings_.tolerance || (a.closest.distance <= near && lies_on(tree_, p))) {
            a.side = Side::on;
            return a;
        }
        if (!settings_.closed) return a;
        a.winding = winding_at(p, a.closest.distance);
        a.side = a.winding != 0 ? Side::inside : Side::outside;
        return a;
    }

  private:
    /// A ball around a point that does not reach the surface is on one side of it. So this point has the
    /// winding number of the previous point if either's ball contains the other. Otherwise the segment
    /// between them is tested.
    int winding_at(const Vec3& p, double distance) {
        const double step = length(p - last_.point),
                     sure = 0.999;                     // a margin far above the rounding of distances
        if (!last_.known || !(step * tree_.scale < 4)) // a long way outside gives little information
            last_.winding = winding(tree_, p);
        else if (!(step < sure * std::max(distance, last_.distance)))
            last_.winding = winding_beside(tree_, last_.point, last_.winding, p);
        last_.known = true;
        last_.point = p;
        last_.distance = distance;
        return last_.winding;
    }

    const FaceTree& tree_;
    const PointSettings& settings_;
    Index hint_ = none;
    struct {
        bool known = false;
        Vec3 point;
        int winding = 0;
        double distance = 0;
    } last_;
};

} // namespace

const char* to_string(Side side) {
    constexpr const char* names[] = {"inside", "outside", "on", "unknown"};
    return names[static_cast<std::size_t>(side)];
}

std::vector<PointAnswer> probe_points(const FaceTree& tree, std::span<const Vec3> points,
                                      const PointSettings& settings) {
    const auto order =
        order_along_curve(points.size(), box_of(points), [&](std::size_t i) { return points[i]; });
    std::vector<PointAnswer> answers(points.size());
    ProgressScope::report_next_loop();
    parallel_chunks(
        points.size(),
        [&](std::size_t begin, std::size_t end) {
            Walk walk(tree, settings);
            for (std::size_t i = begin; i < end; ++i) answers[order[i]] = walk.next(points[order[i]]);
        },
        512);
    return answers;
}

HitLists hits_away(const FaceTree& tree, std::span<const Line> lines) {
    const HitLists all = hits_of(tree, lines, true);
    HitLists away;
    away.offsets.push_back(0);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto touches = [&](const Hit& hit) {
            const auto t = tree.triangle(hit.triangle);
            return t.a == lines[i].from || t.b == lines[i].from || t.c == lines[i].from;
        };
        const auto hits = all.of(i);
        const auto first = std::find_if_not(hits.begin(), hits.end(), touches);
        if (first != hits.end()) away.hits.push_back(*first);
        away.offsets.push_back(away.hits.size());
    }
    return away;
}

} // namespace facetmill
