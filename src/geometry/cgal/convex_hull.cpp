#include "geometry/cgal/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace facetmill {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Halfedges = CGAL::Surface_mesh<Point>;

Point hull_point(const Vec3& p) { return {p.x, p.y, p.z}; }
Vec3 hull_vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

bool lexicographic(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// The triangles with their lowest corner first, sorted.
void sort_triangles(std::vector<std::array<Index, 3>>& triangles) {
    for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles.begin(), triangles.end());
}

} // namespace

ConvexSurface convex_surface(std::span<const Vec3> points) {
    // Sorted and distinct, so that the hull does not depend on their order.
    std::vector<Vec3> distinct(points.begin(), points.end());
    std::sort(distinct.begin(), distinct.end(), lexicographic);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<Point> input;
    input.reserve(distinct.size());
    for (const Vec3& p : distinct) input.push_back(hull_point(p));
    Halfedges hull;
    CGAL::convex_hull_3(input.begin(), input.end(), hull);

    ConvexSurface out;
    out.points.reserve(hull.number_of_vertices());
    out.triangles.reserve(hull.number_of_faces());
    std::vector<Vec3> at;
    at.reserve(hull.number_of_vertices());
    for (const auto v : hull.vertices()) at.push_back(hull_vector(hull.point(v)));
    std::vector<Index> order(at.size()), place(at.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return lexicographic(at[a], at[b]); });
    for (const Index v : order) {
        place[v] = static_cast<Index>(out.points.size());
        out.points.push_back(at[v]);
    }
    for (const auto f : hull.faces()) {
        std::array<Index, 3> abc{};
        std::size_t k = 0;
        for (const auto v : hull.vertices_around_face(hull.halfedge(f)))
            if (k < 3) abc[k++] = place[static_cast<Index>(v)];
        out.triangles.push_back(abc);
    }
    sort_triangles(out.triangles);
    return out;
}

Ball smallest_ball(std::span<const Vec3> points) {
    using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
    std::vector<Point> input;
    input.reserve(points.size());
    for (const Vec3& p : points) input.push_back(hull_point(p));
    CGAL::Min_sphere_of_spheres_d<Traits> sphere(input.begin(), input.end());
    Ball ball;
    std::size_t axis = 0;
    for (auto c = sphere.center_cartesian_begin(); axis < 3; ++c) ball.centre[axis++] = *c;
    for (const Vec3& p : points) ball.radius = std::max(ball.radius, length(p - ball.centre));
    return ball;
}

} // namespace facetmill
