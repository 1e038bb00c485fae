#include "geometry/split/centre.hpp"

#include "geometry/polygon/polygon.hpp"
#include "mesh/face.hpp"
#include "mesh/quad_diagonal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace facetmill {

namespace {

/// The corners of the face, projected along the largest component of its normal, anticlockwise, and relative
/// to the first corner so that numbers stay small.
std::vector<Vec2> flattened(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), n = mesh.face_size(f);
    const Vec3 normal = area_vector(mesh, f);
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    const std::size_t drop = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    std::size_t u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(u, v);
    const Vec3 origin = mesh.point(begin);
    std::vector<Vec2> points(n);
    for (Index k = 0; k < n; ++k) {
        const Vec3 p = mesh.point(begin + k) - origin;
        points[k] = {p[u], p[v]};
    }
    return points;
}

/// Whether the point is on the inner side of every edge that has a length.
bool sees_all(const std::vector<Vec2>& polygon, const Vec2& from) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        if (a == b) continue;
        if (!(cross(b - a, from - a) > 0)) return false;
    }
    return true;
}

/// The part of a convex polygon on the inner side of the edge from a to b.
std::vector<Vec2> clipped(const std::vector<Vec2>& convex, const Vec2& a, const Vec2& b) {
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < convex.size(); ++k) {
        const Vec2 &p = convex[k], &q = convex[(k + 1) % convex.size()];
        const double at_p = cross(b - a, p - a), at_q = cross(b - a, q - a);
        if (at_p >= 0) kept.push_back(p);
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
            kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return kept;
}

/// The centroid of the kernel; none when the kernel has no area.
std::optional<Vec2> kernel_centroid(const std::vector<Vec2>& polygon) {
    Vec2 low = polygon[0], high = polygon[0];
    for (const Vec2& p : polygon) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    std::vector<Vec2> kernel{low, {high.x, low.y}, high, {low.x, high.y}};
    for (std::size_t k = 0; k < polygon.size() && !kernel.empty(); ++k)
        if (!(polygon[k] == polygon[(k + 1) % polygon.size()]))
            kernel = clipped(kernel, polygon[k], polygon[(k + 1) % polygon.size()]);
    double area = 0;
    Vec2 sum;
    for (std::size_t k = 1; k + 1 < kernel.size(); ++k) {
        const double part = cross(kernel[k] - kernel[0], kernel[k + 1] - kernel[0]);
        area += part;
        sum = sum + (kernel[k] - kernel[0] + (kernel[k + 1] - kernel[0])) * part;
    }
    if (!(area > 0)) return {};
    return kernel[0] + sum * (1 / (3 * area));
}

/// Adds the weights that give the point as a mixture of corner k and an edge. A ray from the corner through
/// the point meets this edge. The point is in the kernel, so exactly one such edge exists.
bool add_weights_through(const std::vector<Vec2>& polygon, std::size_t k, const Vec2& point,
                         std::vector<double>& weights) {
    const Vec2 way = point - polygon[k];
    const std::size_t n = polygon.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const std::size_t a = (k + i) % n, b = (k + i + 1) % n;
        const double at_a = cross(way, polygon[a] - polygon[k]), at_b = cross(way, polygon[b] - polygon[k]);
        if (!(at_a <= 0 && at_b > 0)) continue;
        const double t = at_a / (at_a - at_b);
        const Vec2 met = polygon[a] + (polygon[b] - polygon[a]) * t;
        const Vec2 whole = met - polygon[k];
        const double s = dot(way, whole) / dot(whole, whole);
        if (!(s > 0 && s <= 1)) continue; // behind corner k
        weights[k] += 1 - s;
        weights[a] += s * (1 - t);
        weights[b] += s * t;
        return true;
    }
    return false;
}

/// Weights of at least 0 that give the point: the mean of the weights through every corner (or through 64
/// corners, evenly spread). Empty if numerical trouble leaves no weights.
std::vector<double> weights_of(const std::vector<Vec2>& polygon, const Vec2& point) {
    std::vector<double> weights(polygon.size());
    const std::size_t step = (polygon.size() + 63) / 64;
    double found = 0;
    for (std::size_t k = 0; k < polygon.size(); k += step)
        found += add_weights_through(polygon, k, point, weights);
    if (found == 0) return {};
    for (double& w : weights) w /= found;
    return weights;
}

} // namespace

CentreWeights centre_weights(const Mesh& mesh, Index f) {
    const Index n = mesh.face_size(f);
    CentreWeights same{1.0 / n, 1.0 / n, {}};
    if (n == 3) return same;
    if (n == 4) {
        const QuadDiagonals quad = quad_diagonals(mesh, f);
        if (!quad.concave()) return same;
        return quad.first ? CentreWeights{0.5, 0, {}} : CentreWeights{0, 0.5, {}};
    }
    const std::vector<Vec2> polygon = flattened(mesh, f);
    Vec2 mean;
    for (const Vec2& p : polygon) mean = mean + p * (1.0 / n);
    if (sees_all(polygon, mean)) return same;
    const auto point = kernel_centroid(polygon);
    if (!point || !sees_all(polygon, *point)) return same;
    CentreWeights weights{0, 0, weights_of(polygon, *point)};
    return weights.own.empty() ? same : weights;
}

bool hides_from_centre(const Mesh& mesh, Index f, const CentreWeights& weights) {
    const Index begin = mesh.face_begin(f), n = mesh.face_size(f);
    if (n == 4 && quad_diagonals(mesh, f).concave()) return false;
    const Vec3 normal = area_vector(mesh, f);
    Vec3 centre = corner_mean(mesh, f);
    if (!weights.own.empty()) {
        centre = {};
        for (Index k = 0; k < n; ++k) centre += mesh.point(begin + k) * weights.of(k);
    }
    for (Index k = 0; k < n; ++k) {
        const Vec3 &a = mesh.point(begin + k), &b = mesh.point(begin + (k + 1) % n);
        if (dot(cross(b - a, centre - a), normal) < 0) return true;
    }
    return false;
}

} // namespace facetmill
