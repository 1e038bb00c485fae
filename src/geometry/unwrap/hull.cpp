#include "geometry/unwrap/hull.hpp"

#include "geometry/polygon/flat_hull.hpp"

namespace facetmill::unwrap_room {

std::vector<Vec2> convex_hull_of(const std::vector<Vec2>& points) {
    std::vector<FlatPoint> flat;
    flat.reserve(points.size());
    for (const Vec2& p : points) flat.push_back({p.x, p.y, none});
    std::vector<Vec2> hull;
    for (const FlatPoint& p : flat_hull(std::move(flat))) hull.push_back({p.x, p.y});
    return hull;
}

Vec2 axis_of_smallest_rectangle(const std::vector<Vec2>& hull) {
    Vec2 best{1, 0};
    double least = HUGE_VAL;
    const std::size_t n = hull.size();
    if (n < 3)
        return n == 2 && !(hull[0] == hull[1]) ? (hull[1] - hull[0]) * (1 / length(hull[1] - hull[0])) : best;
    std::size_t right = 1, top = 1, left = 1;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 side = hull[(i + 1) % n] - hull[i];
        const Vec2 u = side * (1 / length(side)), v{-u.y, u.x};
        const auto advance = [&](std::size_t& k, const Vec2& along, double sign) {
            for (std::size_t step = 0; step < n; ++step, k = (k + 1) % n)
                if (!(sign * dot(along, hull[(k + 1) % n]) > sign * dot(along, hull[k]))) break;
        };
        advance(right, u, 1);
        if (i == 0) top = right;
        advance(top, v, 1);
        if (i == 0) left = top;
        advance(left, u, -1);
        const double width = dot(u, hull[right] - hull[left]), height = dot(v, hull[top] - hull[i]);
        if (width * height < least) {
            least = width * height;
            best = width >= height ? u : v;
        }
    }
    return best;
}

} // namespace facetmill::unwrap_room
