#include "geometry/cgal/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace facetmill {

std::vector<std::array<Vec3, 3>> convex_hull(std::span<const Vec3> points) {
    using HullPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    std::vector<HullPoint> all;
    all.reserve(points.size());
    for (const Vec3& p : points)
        if (is_finite(p)) all.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<Vec3, 3>> triangles;
    if (all.size() < 3) return triangles;
    CGAL::Surface_mesh<HullPoint> hull;
    CGAL::convex_hull_3(all.begin(), all.end(), hull);
    triangles.reserve(hull.number_of_faces());
    for (const auto face : hull.faces()) {
        std::vector<Vec3> corners;
        for (const auto v : hull.vertices_around_face(hull.halfedge(face))) {
            const HullPoint& p = hull.point(v);
            corners.push_back({p.x(), p.y(), p.z()});
        }
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            triangles.push_back({corners[0], corners[i], corners[i + 1]});
    }
    return triangles;
}

} // namespace facetmill
