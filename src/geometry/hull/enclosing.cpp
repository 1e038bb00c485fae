#include "geometry/hull/enclosing.hpp"

#include "base/math/predicates.hpp"
#include "parallel/parallel.hpp"

#include <cmath>

namespace facetmill {

bool encloses(const ConvexSurface& surface, std::span<const Vec3> points) {
    const auto inside = [&](const Vec3& p) {
        for (const auto& [a, b, c] : surface.triangles)
            if (orientation_3d(surface.points[a], surface.points[b], surface.points[c], p) > 0) return false;
        return true;
    };
    const auto outside = parallel_reduce(
        points.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t i = begin;
            while (i < end && inside(points[i])) ++i;
            return end - i;
        },
        [](std::size_t a, std::size_t b) { return a + b; }, 256);
    return outside == 0;
}

std::optional<ConvexSurface> enlarged_around(const std::vector<Vec3>& corners, const Vec3& centre,
                                             std::span<const Vec3> points, const Growth& growth) {
    std::vector<Vec3> scaled = corners;
    for (double more = 0; more <= growth.most; more = more == 0 ? growth.first : 2 * more) {
        for (std::size_t i = 0; i < corners.size(); ++i)
            scaled[i] = corners[i] + (corners[i] - centre) * more;
        ConvexSurface surface = convex_surface(scaled);
        if (encloses(surface, points)) return surface;
    }
    return std::nullopt;
}

double volume_of(const ConvexSurface& surface) {
    double six = 0;
    const Vec3& o = surface.points.front();
    for (const auto& [a, b, c] : surface.triangles)
        six += dot(surface.points[a] - o, cross(surface.points[b] - o, surface.points[c] - o));
    return six / 6;
}

} // namespace facetmill
