#include "geometry/unwrap/hull.hpp"

#include "base/math/predicates.hpp"

namespace facetmill::unwrap_room {

std::vector<Vec2> convex_hull_of(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Vec2> hull;
    const auto extend = [&](const Vec2& p, std::size_t least) {
        while (hull.size() > least) {
            const Vec2 &a = hull[hull.size() - 2], &b = hull.back();
            if (orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y) > 0) break;
            hull.pop_back();
        }
        hull.push_back(p);
    };
    for (const Vec2& p : points) extend(p, 1);
    const std::size_t lower = hull.size();
    for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
    hull.pop_back();
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
        if (i == 0) right = top = left = 1 % n;
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
