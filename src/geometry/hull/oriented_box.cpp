#include "base/math/predicates.hpp"
#include "geometry/hull/enclosing.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// A candidate: its frame, the ends along each axis, and its volume (or, for flat hulls, its area).
struct BoxCandidate {
    Vec3 axes[3];
    double low[3]{}, high[3]{};
    double size = HUGE_VAL;
};

Vec3 axis_across(const Vec3& n) {
    const Vec3 a{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const Vec3 other = a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0} : a.y <= a.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return normalised(cross(n, other));
}

void measure_ends(BoxCandidate& c, std::span<const Vec3> points) {
    for (std::size_t k = 0; k < 3; ++k) {
        c.low[k] = HUGE_VAL;
        c.high[k] = -HUGE_VAL;
        for (const Vec3& p : points) {
            const double x = dot(c.axes[k], p);
            c.low[k] = std::min(c.low[k], x);
            c.high[k] = std::max(c.high[k], x);
        }
    }
}

constexpr std::size_t tried_faces = 256, tried_edges = 64; // the largest and the longest

/// The best box with a side across the normal n and another along an edge of the outline in this direction.
BoxCandidate best_across(const Vec3& n, std::span<const Vec3> points, double thin) {
    const Vec3 u = axis_across(n), v = cross(n, u);
    double low = HUGE_VAL, high = -HUGE_VAL;
    std::vector<FlatPoint> flat;
    flat.reserve(points.size());
    for (const Vec3& p : points) {
        flat.push_back({dot(u, p), dot(v, p), none});
        low = std::min(low, dot(n, p));
        high = std::max(high, dot(n, p));
    }
    const std::vector<FlatPoint> ring = flat_hull(std::move(flat));
    std::vector<FlatPoint> edges;
    edges.reserve(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FlatPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
        edges.push_back({b.x - a.x, b.y - a.y, none});
    }
    const auto square = [](const FlatPoint& e) { return e.x * e.x + e.y * e.y; };
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const FlatPoint& a, const FlatPoint& b) { return square(a) > square(b); });
    if (edges.size() > tried_edges) edges.resize(tried_edges);
    BoxCandidate best;
    FlatPoint along{1, 0, none};
    double least = HUGE_VAL;
    for (const FlatPoint& e : edges) {
        const double l = std::sqrt(square(e));
        if (!(l > 0)) continue;
        const FlatPoint d{e.x / l, e.y / l, none};
        double min[2] = {HUGE_VAL, HUGE_VAL}, max[2] = {-HUGE_VAL, -HUGE_VAL};
        for (const FlatPoint& p : ring) {
            const double s[2] = {d.x * p.x + d.y * p.y, d.x * p.y - d.y * p.x};
            for (int k = 0; k < 2; ++k) {
                min[k] = std::min(min[k], s[k]);
                max[k] = std::max(max[k], s[k]);
            }
        }
        const double area = (max[0] - min[0]) * (max[1] - min[1]);
        if (area < least) {
            least = area;
            along = d;
        }
    }
    best.axes[2] = n;
    best.axes[0] = normalised(u * along.x + v * along.y);
    best.axes[1] = cross(n, best.axes[0]);
    best.size = least * std::max(high - low, thin);
    return best;
}

/// The unit normals of the largest triangles.
std::vector<Vec3> tried_normals(const ConvexSurface& hull) {
    std::vector<Vec3> normals;
    normals.reserve(hull.triangles.size());
    for (const auto& [a, b, c] : hull.triangles)
        normals.push_back(cross(hull.points[b] - hull.points[a], hull.points[c] - hull.points[a]));
    std::stable_sort(normals.begin(), normals.end(),
                     [](const Vec3& a, const Vec3& b) { return dot(a, a) > dot(b, b); });
    if (normals.size() > tried_faces) normals.resize(tried_faces);
    std::erase_if(normals, [](const Vec3& n) { return !(dot(n, n) > 0); });
    for (Vec3& n : normals) n = normalised(n);
    return normals;
}

} // namespace

FittedBox oriented_box(const ConvexSurface& hull) {
    const std::vector<Vec3> normals = tried_normals(hull);
    std::vector<BoxCandidate> all(normals.size() + 1);
    all.back() = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    measure_ends(all.back(), hull.points);
    const auto extent = [&](std::size_t k) { return all.back().high[k] - all.back().low[k]; };
    // Flat boxes count as this thick, so that their areas are compared.
    const double thin = 0x1p-40 * std::max({extent(0), extent(1), extent(2)});
    all.back().size = std::max(extent(0), thin) * std::max(extent(1), thin) * std::max(extent(2), thin);
    parallel_for(
        normals.size(), [&](std::size_t i) { all[i] = best_across(normals[i], hull.points, thin); }, 8);
    // The box along the axes is last, and wins unless another is smaller by more than rounding.
    BoxCandidate best = all.back();
    best.size *= 1 - 1e-9;
    for (const BoxCandidate& c : all)
        if (c.size < best.size) best = c;
    measure_ends(best, hull.points);
    FittedBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.axes[k] = best.axes[k];
        box.size[k] = best.high[k] - best.low[k];
        box.centre += best.axes[k] * ((best.low[k] + best.high[k]) / 2);
    }
    return box;
}

std::vector<Vec3> box_corners(const FittedBox& box) {
    constexpr double thin = 9.0949470177292824e-13; // 2^-40
    const double size = length(box.size);
    std::vector<Vec3> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i) {
        Vec3 p = box.centre;
        for (std::size_t k = 0; k < 3; ++k)
            p += box.axes[k] * (std::max(box.size[k], thin * size) / ((i >> k) & 1 ? 2 : -2));
        corners.push_back(p);
    }
    return corners;
}

} // namespace facetmill
