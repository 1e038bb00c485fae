#include "geometry/simplify/judge.hpp"

#include "base/parallel.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "mesh/bare.hpp"

namespace facetmill::simplification {

namespace {

/// Whether a point of one surface (of those that the deviation samples) is farther than `bound` from another.
bool any_beyond(const Surface& surface, const FaceTree& tree, double bound) {
    const DeviationSettings settings;
    const auto samples = sample_area(surface, settings.samples, settings.seed);
    const std::size_t all = samples.size() + surface.positions.size();
    return parallel_reduce(
               all, 0,
               [&](std::size_t begin, std::size_t end) {
                   Index hint = none;
                   for (std::size_t i = begin; i < end; ++i) {
                       const Vec3& p =
                           i < samples.size() ? samples[i].point : surface.positions[i - samples.size()];
                       const Closest found = closest_point(tree, p, hint, bound);
                       if (!(found.distance <= bound)) return 1;
                       hint = found.triangle;
                   }
                   return 0;
               },
               [](int a, int b) { return a | b; }, 2048) != 0;
}

/// The positions and faces alone, without vertices that no face uses.
Mesh used(const Mesh& from) {
    Mesh out = bare(from);
    drop_unused(out);
    return out;
}

} // namespace

Judge::Judge(const Mesh& from, double bound)
    : surface_(surface_of(used(from))), tree_(surface_), bound_(bound) {}

bool Judge::within(const Mesh& mesh) const {
    const Surface now = surface_of(mesh);
    return !any_beyond(now, tree_, bound_) && !any_beyond(surface_, FaceTree(now), bound_);
}

double Judge::deviation(const Mesh& mesh) const {
    const Surface now = surface_of(mesh);
    return std::max(deviation_to(surface_, FaceTree(now)).maximum, deviation_to(now, tree_).maximum);
}

} // namespace facetmill::simplification
