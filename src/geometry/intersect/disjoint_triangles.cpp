// Tests separating lines of the triangles projected along an axis, then separating planes. In the plane, the
// thresholds of signs come from J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast
// robust geometric predicates" (1997). In space, they come from the semi-static filter of A. Meyer and S.
// Pion, "FPG: a code generator for fast and certified geometric predicates" (2008).
#include "geometry/intersect/disjoint_triangles.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Two triangles projected along an axis.
struct View {
    double a[3][2], b[3][2];

    View(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t, std::size_t axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (std::size_t i = 0; i < 3; ++i) {
            a[i][0] = s[i][u];
            a[i][1] = s[i][v];
            b[i][0] = t[i][u];
            b[i][1] = t[i][v];
        }
    }
};

using Point2 = double[2];

/// The side of the line from p to q that contains r; 0 if uncertain.
int side(const Point2& p, const Point2& q, const Point2& r) {
    return sure_sign((q[0] - p[0]) * (r[1] - p[1]), (q[1] - p[1]) * (r[0] - p[0]));
}

/// Whether all of t is beyond an edge of s.
bool beyond_an_edge(const double (&s)[3][2], const double (&t)[3][2]) {
    const int way = side(s[0], s[1], s[2]);
    if (way == 0) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 &p = s[i], &q = s[(i + 1) % 3];
        if (side(p, q, t[0]) == -way && side(p, q, t[1]) == -way && side(p, q, t[2]) == -way) return true;
    }
    return false;
}

/// Whether the angles of two triangles at their common first corner share only that corner: no side of one
/// angle is inside the other.
bool corners_disjoint(const View& view) {
    const auto& a = view.a;
    const auto& b = view.b;
    const int way_a = side(a[0], a[1], a[2]), way_b = side(a[0], b[1], b[2]);
    if (way_a == 0 || way_b == 0) return false;
    int s[3][3]; // relation of side i of a to side j of b
    for (std::size_t i = 1; i < 3; ++i)
        for (std::size_t j = 1; j < 3; ++j)
            if ((s[i][j] = side(a[0], a[i], b[j])) == 0) return false;
    const auto b_in_a = [&](std::size_t j) { return s[1][j] == way_a && s[2][j] == -way_a; };
    const auto a_in_b = [&](std::size_t i) { return s[i][1] == -way_b && s[i][2] == way_b; };
    return !b_in_a(1) && !b_in_a(2) && !a_in_b(1) && !a_in_b(2);
}

/// Whether the corners of t, from the given corner on, are all strictly on one side of the plane of s.
bool beside_the_plane(const std::array<Vec3, 3>& s, const Vec3& normal, const std::array<Vec3, 3>& t,
                      std::size_t first) {
    const Vec3 u = s[1] - s[0], v = s[2] - s[0];
    int way = 0;
    for (std::size_t i = first; i < 3; ++i) {
        const Vec3 w = t[i] - s[0];
        const auto most = [&](std::size_t k) {
            return std::max({std::abs(u[k]), std::abs(v[k]), std::abs(w[k])});
        };
        const double x = most(0), y = most(1), z = most(2), size = x * y * z, det = dot(normal, w);
        // The bound covers 46 roundings of numbers up to `size`, without overflow and underflow.
        const bool sure =
            std::abs(det) > 5.2e-15 * size && size > 1e-270 && size < 1e270 && std::min({x, y, z}) > 1e-90;
        const int sign = !sure ? 0 : det > 0 ? 1 : -1;
        if (sign == 0 || (way != 0 && sign != way)) return false;
        way = sign;
    }
    return true;
}

std::size_t longest_axis(const Vec3& v) {
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

} // namespace

bool surely_disjoint(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, int shared) {
    const Vec3 normal = cross(a[1] - a[0], a[2] - a[0]);
    const View view(a, b, longest_axis(normal));
    if (shared == 2) { // they meet elsewhere only if folded flat onto each other
        const int way_a = side(view.a[0], view.a[1], view.a[2]),
                  way_b = side(view.a[0], view.a[1], view.b[2]);
        return way_a * way_b < 0 || beside_the_plane(a, normal, b, 2);
    }
    if (shared == 1 ? corners_disjoint(view)
                    : beyond_an_edge(view.a, view.b) || beyond_an_edge(view.b, view.a))
        return true;
    const auto first = static_cast<std::size_t>(shared);
    return beside_the_plane(a, normal, b, first) ||
           beside_the_plane(b, cross(b[1] - b[0], b[2] - b[0]), a, first);
}

} // namespace facetmill
