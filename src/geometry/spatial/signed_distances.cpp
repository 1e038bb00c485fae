#include "geometry/spatial/signed_distances.hpp"

#include "geometry/spatial/closest_point.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

std::vector<float> signed_distances(const FaceTree& tree, std::span<const Vec3> points) {
    const auto found = closest_points(tree, points);
    std::vector<float> distances(points.size());
    parallel_for(points.size(), [&](std::size_t v) {
        const Closest& c = found[v];
        if (c.triangle == none) return; // not finite
        const auto [p, q, r] = tree.triangle(c.triangle);
        const Vec3 normal = cross(q - p, r - p);
        distances[v] = static_cast<float>(dot(points[v] - c.point, normal) < 0 ? -c.distance : c.distance);
    });
    return distances;
}

} // namespace facetmill
