#include "geometry/polygon/polygon.hpp"

#include "base/math/exact_integer.hpp"
#include "base/math/exact_sum.hpp"
#include "base/math/predicates.hpp"
#include "geometry/polygon/ring_tree.hpp"
#include "geometry/polygon/triangulate_rings.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::polygon {

namespace {

/// Integrals over a ring, relative to a reference point. The sums are from P. Bourke, "Calculating the area
/// and centroid of a polygon" (1988), with their factors.
struct Integrals {
    double one = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

    void add(const Vec2& a, const Vec2& b) {
        const double c = cross(a, b);
        one += c / 2;
        x += (a.x + b.x) * c / 6;
        y += (a.y + b.y) * c / 6;
        yy += (a.y * a.y + a.y * b.y + b.y * b.y) * c / 12;
        xx += (a.x * a.x + a.x * b.x + b.x * b.x) * c / 12;
        xy += (a.x * b.y + 2 * a.x * a.y + 2 * b.x * b.y + b.x * a.y) * c / 24;
    }
};

const Vec2& following(Ring ring, std::size_t i) { return ring[i + 1 == ring.size() ? 0 : i + 1]; }

/// Computes the orientation for numbers whose products doubles cannot hold.
int integer_orientation(Ring ring) {
    mpz_class twice;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = following(ring, i);
        twice += exact_integer(a.x) * exact_integer(b.y) - exact_integer(b.x) * exact_integer(a.y);
    }
    return sgn(twice);
}

} // namespace

double signed_area(Ring ring) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
    return twice / 2;
}

int orientation(Ring ring) {
    if (ring.size() == 3) return turn(ring[0], ring[1], ring[2]);
    double twice = 0, size = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const Vec2 a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
        twice += cross(a, b);
        size += std::abs(a.x * b.y) + std::abs(a.y * b.x);
    }
    // The error of each term is at most 4 rounding units of its size. Adding n terms adds n units.
    const double bound = size * (static_cast<double>(ring.size()) + 4) * 2.3e-16 + orientation_smallest;
    if (std::abs(twice) > bound) return twice > 0 ? 1 : -1;
    ExactSum<> exact;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = following(ring, i);
        exact.add_product(a.x, b.y);
        exact.add_product(-b.x, a.y);
    }
    return exact.holds() ? exact.sign() : integer_orientation(ring);
}

PrincipalAxes principal_axes(const SecondMoments& m) {
    PrincipalAxes axes;
    const double mean = (m.x + m.y) / 2, half = (m.x - m.y) / 2, r = std::sqrt(half * half + m.xy * m.xy);
    axes.largest = mean + r;
    axes.smallest = mean - r;
    if (r > 0) {
        const double c = half / r, s = -m.xy / r; // cosine and sine of twice the angle
        if (c >= 0) {
            axes.major.x = std::sqrt((1 + c) / 2);
            axes.major.y = s / (2 * axes.major.x);
        } else {
            axes.major.y = std::sqrt((1 - c) / 2);
            axes.major.x = s / (2 * axes.major.y);
        }
    }
    axes.minor = {-axes.major.y, axes.major.x};
    return axes;
}

std::optional<Moments> moments(Rings rings) {
    const auto first = std::find_if(rings.begin(), rings.end(), [](Ring r) { return !r.empty(); });
    if (first == rings.end()) return {};
    const Vec2 o = first->front();
    Integrals sum;
    for (const Ring ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) sum.add(ring[i] - o, following(ring, i) - o);
    if (sum.one == 0) return {};
    const double sign = sum.one > 0 ? 1 : -1;
    Moments m;
    m.area = sign * sum.one;
    const Vec2 c{sum.x / sum.one, sum.y / sum.one};
    m.centroid = o + c;
    m.about_centroid = {sign * (sum.yy - sum.y * c.y), sign * (sum.xx - sum.x * c.x),
                        sign * (sum.xy - sum.x * c.y)};
    m.about_origin = {m.about_centroid.x + m.area * m.centroid.y * m.centroid.y,
                      m.about_centroid.y + m.area * m.centroid.x * m.centroid.x,
                      m.about_centroid.xy + m.area * m.centroid.x * m.centroid.y};
    m.axes = principal_axes(m.about_centroid);
    return m;
}

std::optional<Moments> moments(Ring ring) { return moments(Rings(&ring, 1)); }

Vec3 area_vector(std::span<const Vec3> p) {
    Vec3 twice;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) twice += cross(p[i] - p[0], p[i + 1] - p[0]);
    return twice * 0.5;
}

double area(std::span<const Vec3> p) {
    if (p.size() == 4) return length(cross(p[2] - p[0], p[3] - p[1])) / 2;
    return length(area_vector(p));
}

namespace {

/// The normal of the polygon's plane, not of unit length. If its parts cancel in the sum (a bow-tie), this
/// is the normal of its largest triangle at the corner farthest from the first. Zero if all corners are on a
/// line.
Vec3 upright(std::span<const Vec3> p) {
    const Vec3 area = area_vector(p);
    Vec3 far, largest;
    for (const Vec3& q : p)
        if (length(q - p[0]) > length(far)) far = q - p[0];
    if (length(area) > 1e-12 * dot(far, far)) return area;
    for (const Vec3& q : p) {
        const Vec3 normal = cross(far, q - p[0]);
        if (length(normal) > length(largest)) largest = normal;
    }
    return dot(largest, area) < 0 ? -largest : largest;
}

} // namespace

Vec3 plane_normal(std::span<const Vec3> corners) { return normalised(upright(corners)); }

double plane_deviation(std::span<const Vec3> p) {
    if (p.size() <= 3) return 0;
    const Vec3 normal = plane_normal(p);
    Vec3 mean;
    for (const Vec3& q : p) mean += q - p[0];
    mean = p[0] + mean / static_cast<double>(p.size());
    double most = 0;
    for (const Vec3& q : p) most = std::max(most, std::abs(dot(q - mean, normal)));
    return most;
}

std::vector<Vec2> flattened(std::span<const Vec3> corners) {
    const Vec3 normal = upright(corners);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<Vec2> flat;
    flat.reserve(corners.size());
    for (const Vec3& p : corners) flat.push_back({p[u], p[v]});
    return flat;
}

bool is_convex(Ring ring) {
    const std::size_t n = ring.size();
    if (n < 3) return false;
    int sign = 0, reversals = 0, first = 0, last = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = ring[i], &b = following(ring, i), &c = ring[(i + 2) % n];
        const int t = turn(a, b, c);
        if (t * sign < 0) return false;
        if (t != 0) sign = t;
        // In a ring that goes round once, the edges change between rising and falling (by x, then y) exactly
        // twice.
        const int rises = a.x < b.x || (a.x == b.x && a.y < b.y) ? 1 : a == b ? 0 : -1;
        if (rises == 0) continue;
        if (last != 0 && rises != last) ++reversals;
        if (first == 0) first = rises;
        last = rises;
    }
    return sign != 0 && reversals + (first != last) == 2;
}

const char* to_string(Kind kind) {
    constexpr const char* names[kinds] = {"triangle",          "quad",      "convex", "concave", "complex",
                                          "self_intersecting", "degenerate"};
    return names[static_cast<int>(kind)];
}

Kind classify(Ring ring) { return classify(Rings(&ring, 1)); }

Kind classify(Rings rings) {
    if (rings.size() == 1) {
        const Ring ring = rings[0];
        if (is_convex(ring))
            return ring.size() == 3 ? Kind::triangle : ring.size() == 4 ? Kind::quad : Kind::convex;
        if (ring.size() <= 3) return Kind::degenerate;
    }
    const Contact how = contact(rings);
    if (how == Contact::none && rings.size() == 1) return Kind::concave;
    if (how == Contact::crossing) return Kind::self_intersecting;
    const WindingRange range = winding_range(rings);
    if (range.min == 0 && range.max == 0) return Kind::degenerate;
    return range.max - range.min == 1 ? Kind::complex : Kind::self_intersecting;
}

} // namespace facetmill::polygon
