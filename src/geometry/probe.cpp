#include "geometry/probe.hpp"

#include "base/parallel.hpp"
#include "geometry/space_curve.hpp"

namespace facetmill {

namespace {

PointAnswer answer(const FaceTree& tree, const Vec3& p, const PointSettings& settings, Index hint) {
    PointAnswer a;
    a.closest = closest_point(tree, p, hint);
    if (a.closest.face == none) { // nothing there, or no such point
        a.side = settings.closed && is_finite(p) ? Side::outside : Side::unknown;
        return a;
    }
    // A point exactly on the surface is closer than the rounding of distances can say.
    const double near = 1e-12 / tree.scale;
    if (a.closest.distance <= settings.tolerance || (a.closest.distance <= near && lies_on(tree, p))) {
        a.side = Side::on;
        return a;
    }
    if (!settings.closed) return a;
    a.winding = winding(tree, p);
    a.side = a.winding != 0 ? Side::inside : Side::outside;
    return a;
}

} // namespace

const char* spelled(Side side) {
    constexpr const char* names[] = {"inside", "outside", "on", "unknown"};
    return names[static_cast<std::size_t>(side)];
}

std::vector<PointAnswer> probe_points(const FaceTree& tree, std::span<const Vec3> points,
                                      const PointSettings& settings) {
    const auto order =
        order_along_curve(points.size(), box_of(points), [&](std::size_t i) { return points[i]; });
    std::vector<PointAnswer> answers(points.size());
    parallel_chunks(
        points.size(),
        [&](std::size_t begin, std::size_t end) {
            Index hint = none;
            for (std::size_t i = begin; i < end; ++i) {
                answers[order[i]] = answer(tree, points[order[i]], settings, hint);
                hint = answers[order[i]].closest.triangle;
            }
        },
        512);
    return answers;
}

} // namespace facetmill
