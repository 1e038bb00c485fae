#include "geometry/cgal/fair_patch.hpp"

#define CGAL_EIGEN3_ENABLED 1 // fairing solves a sparse system
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

namespace facetmill {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Halfedges = CGAL::Surface_mesh<Point>;

bool add_faces(Halfedges& surface, const std::vector<std::array<Index, 3>>& triangles,
               std::vector<Halfedges::Face_index>* faces) {
    for (const auto& t : triangles) {
        const auto f = surface.add_face(Halfedges::Vertex_index(t[0]), Halfedges::Vertex_index(t[1]),
                                        Halfedges::Vertex_index(t[2]));
        if (f == Halfedges::null_face()) return false;
        if (faces) faces->push_back(f);
    }
    return true;
}

Point point_of(const Vec3& p) { return {p.x, p.y, p.z}; }

} // namespace

HolePatch fair_patch(const std::vector<Vec3>& outline, const std::vector<std::array<Index, 3>>& triangles,
                     const HolePatch& around) {
    const HolePatch plain{triangles, {}};
    Halfedges surface;
    for (const Vec3& p : outline) surface.add_vertex(point_of(p));
    for (const Vec3& p : around.points) surface.add_vertex(point_of(p));
    const std::size_t before = surface.number_of_vertices();
    std::vector<Halfedges::Face_index> faces, new_faces;
    if (!add_faces(surface, around.triangles, nullptr) || !add_faces(surface, plain.triangles, &faces))
        return plain;
    std::vector<Halfedges::Vertex_index> new_vertices;
    pmp::refine(surface, faces, std::back_inserter(new_faces), std::back_inserter(new_vertices));
    if (!new_vertices.empty() && !pmp::fair(surface, new_vertices, pmp::parameters::fairing_continuity(1)))
        return plain;
    HolePatch patch;
    for (std::size_t v = before; v < surface.number_of_vertices(); ++v) {
        const Point& p = surface.point(Halfedges::Vertex_index(static_cast<Index>(v)));
        const Vec3 at{p.x(), p.y(), p.z()};
        if (!is_finite(at)) return plain;
        patch.points.push_back(at);
    }
    faces.insert(faces.end(), new_faces.begin(), new_faces.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (const auto f : faces) {
        std::array<Index, 3> abc{};
        std::size_t k = 0;
        for (const auto v : surface.vertices_around_face(surface.halfedge(f))) {
            const auto i = static_cast<Index>(v);
            abc[k++] = i < before ? i : static_cast<Index>(outline.size() + (i - before));
        }
        patch.triangles.push_back(abc);
    }
    return patch;
}

} // namespace facetmill
