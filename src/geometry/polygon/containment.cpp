#include "base/math/angle.hpp"
#include "base/math/portable_math.hpp"
#include "base/math/predicates.hpp"
#include "geometry/polygon/polygon.hpp"

namespace facetmill::polygon {

namespace {

bool between(double a, double x, double b) { return (a <= x && x <= b) || (b <= x && x <= a); }

} // namespace

const char* to_string(PointLocation place) {
    constexpr const char* names[] = {"outside", "inside", "on_edge", "on_vertex"};
    return names[static_cast<int>(place)];
}

PointLocation locate(const Vec2& p, Rings rings) {
    bool inside = false, on_edge = false;
    for (const Ring ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &a = ring[i], &b = ring[i + 1 == ring.size() ? 0 : i + 1];
            if (a == p) return PointLocation::on_vertex;
            const bool a_below = a.y <= p.y, b_below = b.y <= p.y;
            if (a_below == b_below) {
                on_edge = on_edge || (a.y == p.y && b.y == p.y && between(a.x, p.x, b.x));
                continue;
            }
            const int side = orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y);
            on_edge = on_edge || side == 0;
            if ((side > 0) == a_below) inside = !inside;
        }
    return on_edge ? PointLocation::on_edge : inside ? PointLocation::inside : PointLocation::outside;
}

PointLocation locate(const Vec2& p, Ring ring) { return locate(p, Rings(&ring, 1)); }

PointLocation locate_convex(const Vec2& p, Ring ring) {
    bool left = false, right = false, on = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (a == p) return PointLocation::on_vertex;
        const int side = orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y);
        (side > 0 ? left : side < 0 ? right : on) = true;
    }
    if (left == right) return PointLocation::outside;
    return on ? PointLocation::on_edge : PointLocation::inside;
}

double angle_sum(const Vec2& p, Ring ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i] - p, b = ring[i + 1 == ring.size() ? 0 : i + 1] - p;
        sum += arc_tangent(cross(a, b), dot(a, b));
    }
    return sum;
}

bool inside_by_angles(const Vec2& p, Rings rings) {
    double sum = 0;
    for (const Ring ring : rings) sum += angle_sum(p, ring);
    return std::abs(sum) >= pi;
}

double angle_sum(const Vec3& q, std::span<const Vec3> convex) {
    double sum = 0;
    for (std::size_t i = 0; i < convex.size(); ++i) {
        const Vec3 a = convex[i] - q, b = convex[i + 1 == convex.size() ? 0 : i + 1] - q;
        // The arc cosine of P. Bourke, "Determining if a point lies on the interior of a polygon" (1987),
        // loses half the digits of small angles. This arc tangent does not.
        sum += angle_between(a, b);
    }
    return sum;
}

bool inside_by_angles(const Vec3& q, std::span<const Vec3> convex, double tolerance) {
    for (const Vec3& p : convex)
        if (p == q) return true;
    return angle_sum(q, convex) >= 2 * pi - tolerance;
}

} // namespace facetmill::polygon
