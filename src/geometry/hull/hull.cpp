#include "geometry/hull/hull.hpp"

#include "base/error.hpp"
#include "base/math/predicates.hpp"
#include "geometry/generate/generate.hpp"
#include "geometry/hull/enclosing.hpp"
#include "mesh/power_scale.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

/// Points that span the smallest flat around all points: one more than its dimension.
std::vector<Index> spanning(std::span<const Vec3> points) {
    std::vector<Index> span;
    for (Index i = 0; i < points.size() && span.size() < 4; ++i) {
        const Vec3& p = points[i];
        const auto at = [&](std::size_t k) { return points[span[k]]; };
        if (span.empty() || (span.size() == 1 && !(p == at(0))) ||
            (span.size() == 2 && !collinear(at(0), at(1), p)) ||
            (span.size() == 3 && orientation_3d(at(0), at(1), at(2), p) != 0))
            span.push_back(i);
    }
    return span;
}

/// The outline of coplanar points with a front and a back. Their diagonals differ, so no edge has four faces.
ConvexSurface flat_surface(std::span<const Vec3> points, const std::vector<Index>& span) {
    std::size_t x = 0, y = 1;
    const auto sign = [&] {
        const Vec3 &a = points[span[0]], &b = points[span[1]], &c = points[span[2]];
        return orientation_2d(a[x], a[y], b[x], b[y], c[x], c[y]);
    };
    for (std::size_t across = 2; sign() == 0 && across > 0; --across) {
        x = across == 2 ? 1 : 0;
        y = 2;
    }
    std::vector<FlatPoint> flat;
    flat.reserve(points.size());
    for (Index i = 0; i < points.size(); ++i) flat.push_back({points[i][x], points[i][y], i});
    ConvexSurface surface;
    for (const FlatPoint& p : flat_hull(std::move(flat))) surface.points.push_back(points[p.of]);
    const auto n = static_cast<Index>(surface.points.size());
    for (Index i = 2; i < n; ++i) surface.triangles.push_back({0, i - 1, i});
    for (Index i = 3; i <= n; ++i) surface.triangles.push_back({1, i % n, i - 1});
    return surface;
}

Mesh mesh_of(const ConvexSurface& surface, const PowerScale& back) {
    Mesh mesh;
    mesh.positions = back(surface.points);
    mesh.corners.reserve(3 * surface.triangles.size());
    for (const auto& t : surface.triangles) mesh.corners.insert(mesh.corners.end(), t.begin(), t.end());
    return mesh;
}

/// An icosphere around the unit ball, with at most this many vertices (0: any number).
std::vector<Vec3> around_unit_ball(std::size_t max_vertices) {
    GenerateSettings settings;
    settings.shape = Shape::icosphere;
    settings.subdivisions = max_vertices == 0 || max_vertices >= 162 ? 2 : max_vertices >= 42 ? 1 : 0;
    Mesh ball = generate(settings);
    double inner = 1;
    for (Index f = 0; f < ball.face_count(); ++f) {
        const Vec3 &a = ball.point(3 * f), &b = ball.point(3 * f + 1), &c = ball.point(3 * f + 2);
        inner = std::min(inner, dot(normalised(cross(b - a, c - a)), a));
    }
    for (Vec3& p : ball.positions) p = p / inner;
    return ball.positions;
}

FittedCapsule capsule_around(const ConvexSurface& hull) {
    const FittedBox box = oriented_box(hull);
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (box.size[i] > box.size[k]) k = i;
    const Vec3 axis = box.axes[k];
    std::vector<Vec3> across;
    across.reserve(hull.points.size());
    for (const Vec3& p : hull.points) across.push_back(p - axis * dot(axis, p));
    const Ball circle = smallest_ball(across);
    double first = HUGE_VAL, last = -HUGE_VAL; // the ends along the axis
    for (std::size_t i = 0; i < across.size(); ++i) {
        const Vec3 off = across[i] - circle.centre;
        const double reach = std::sqrt(std::max(0.0, circle.radius * circle.radius - dot(off, off)));
        const double at = dot(axis, hull.points[i] - circle.centre);
        first = std::min(first, at + reach);
        last = std::max(last, at - reach);
    }
    if (first > last) first = last = (first + last) / 2;
    FittedCapsule capsule{{circle.centre + axis * first, circle.centre + axis * last}, 0};
    for (std::size_t i = 0; i < across.size(); ++i) {
        const Vec3& p = hull.points[i];
        const double at = std::clamp(dot(axis, p - circle.centre), first, last);
        capsule.radius = std::max(capsule.radius, length(p - (circle.centre + axis * at)));
    }
    return capsule;
}

Vec3 mean_point(const std::vector<Vec3>& points) {
    Vec3 sum;
    for (const Vec3& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

ConvexSurface certified(const std::vector<Vec3>& corners, const Vec3& centre, std::span<const Vec3> points) {
    if (auto surface = enlarged_around(corners, centre, points)) return *std::move(surface);
    throw Error(ErrorKind::stage, "E-HULL", "hull: no shape around these points could be certified",
                "move the part to the origin with transform, or use shape: hull without max_vertices");
}

/// The shape around the hull, as a mesh and in numbers. All in the scale of the hull.
ConvexSurface shape_around(const ConvexSurface& hull, const HullSettings& s, HullResult& out) {
    if (s.shape == HullShape::box) {
        const FittedBox box = oriented_box(hull);
        out.fitted = box;
        return certified(box_corners(box), box.centre, hull.points);
    }
    if (s.shape == HullShape::hull) {
        const std::vector<Vec3> corners = polytope_around(hull, s.max_vertices);
        return certified(corners, mean_point(corners), hull.points);
    }
    FittedCapsule capsule;
    if (s.shape == HullShape::sphere) {
        const Ball ball = smallest_ball(hull.points);
        out.fitted = FittedSphere{ball.centre, ball.radius};
        capsule = {{ball.centre, ball.centre}, ball.radius};
    } else {
        capsule = capsule_around(hull);
        out.fitted = capsule;
    }
    std::vector<Vec3> corners;
    for (const Vec3& end : capsule.ends)
        for (const Vec3& p :
             around_unit_ball(s.shape == HullShape::sphere ? s.max_vertices : s.max_vertices / 2))
            corners.push_back(end + p * capsule.radius);
    if (s.max_vertices > 0 && corners.size() > s.max_vertices) // two icosahedra have 24
        if (const ConvexSurface both = convex_surface(corners); both.points.size() > s.max_vertices)
            corners = polytope_around(both, s.max_vertices);
    return certified(corners, (capsule.ends[0] + capsule.ends[1]) / 2, hull.points);
}

/// The corners of a cube around each point. The sides of the cubes are twice the margin.
std::vector<Vec3> padded(std::span<const Vec3> points, double margin) {
    std::vector<Vec3> out;
    out.reserve(8 * points.size());
    for (const Vec3& p : points)
        for (int i = 0; i < 8; ++i)
            out.push_back(p +
                          Vec3{i & 1 ? margin : -margin, i & 2 ? margin : -margin, i & 4 ? margin : -margin});
    return out;
}

/// The hull of points with a margin. It grows about its middle, which adds no vertices. Thin hulls would grow
/// too much, so they get more vertices instead.
ConvexSurface hull_with_margin(std::span<const Vec3> points, bool is_solid, double margin) {
    if (!is_solid) return convex_surface(padded(points, margin));
    const ConvexSurface hull = convex_surface(points);
    const std::vector<Vec3> cubes = padded(hull.points, margin);
    const double first = margin / box_of(hull.points).longest_side();
    constexpr double most = 0.004; // more would be visible
    if (auto grown = enlarged_around(hull.points, mean_point(hull.points), cubes, {first, most}))
        return *std::move(grown);
    return convex_surface(cubes);
}

void scale_fitted(HullResult& out, const PowerScale& back) {
    const double factor = back({1, 0, 0}).x;
    if (auto* box = std::get_if<FittedBox>(&out.fitted)) {
        box->centre = back(box->centre);
        box->size *= factor;
    } else if (auto* sphere = std::get_if<FittedSphere>(&out.fitted)) {
        *sphere = {back(sphere->centre), sphere->radius * factor};
    } else if (auto* capsule = std::get_if<FittedCapsule>(&out.fitted)) {
        *capsule = {{back(capsule->ends[0]), back(capsule->ends[1])}, capsule->radius * factor};
    }
}

} // namespace

HullDimension dimension_of(std::span<const Vec3> points) {
    return static_cast<HullDimension>(spanning(points).size());
}

std::vector<Vec3> hull_points(const Mesh& mesh) {
    std::vector<std::uint8_t> used(mesh.vertex_count(), mesh.corners.empty() && mesh.lines.empty());
    for (const Index w : mesh.corners) used[mesh.vertex_of_wedge(w)] = 1;
    for (const Index w : mesh.lines) used[mesh.vertex_of_wedge(w)] = 1;
    std::vector<Vec3> points;
    points.reserve(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (used[v] && is_finite(mesh.positions[v])) points.push_back(mesh.positions[v]);
    return points;
}

HullResult convex_hull(std::span<const Vec3> points, const HullSettings& settings) {
    HullResult out;
    const std::vector<Index> span = spanning(points);
    out.dimension = static_cast<HullDimension>(span.size());
    if (span.empty() || (span.size() < 3 && settings.margin == 0)) return out;
    const PowerScale scale = even_scale(box_of(points));
    std::vector<Vec3> scaled;
    if (!scale.none()) {
        scaled = scale(std::vector<Vec3>(points.begin(), points.end()));
        points = scaled;
    }
    const bool is_flat = span.size() == 3 && settings.margin == 0;
    const double margin = scale({settings.margin, 0, 0}).x;
    const ConvexSurface hull = is_flat      ? flat_surface(points, span)
                               : margin > 0 ? hull_with_margin(points, span.size() == 4, margin)
                                            : convex_surface(points);
    out.hull_vertices = hull.points.size();
    out.hull_volume = unscaled(is_flat ? 0 : volume_of(hull), scale.volume());
    if (settings.shape == HullShape::hull &&
        (settings.max_vertices == 0 || hull.points.size() <= settings.max_vertices)) {
        out.mesh = mesh_of(hull, scale.inverse());
        out.volume = out.hull_volume;
        return out;
    }
    const ConvexSurface shape = shape_around(hull, settings, out);
    out.volume = unscaled(volume_of(shape), scale.volume());
    out.mesh = mesh_of(shape, scale.inverse());
    scale_fitted(out, scale.inverse());
    return out;
}

} // namespace facetmill
