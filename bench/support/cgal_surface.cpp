#define CGAL_LINKED_WITH_TBB
#include "support/cgal_surface.hpp"

#include "parallel/parallel.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace facetmill::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
#if CGAL_VERSION_MAJOR >= 6
using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

} // namespace

struct CgalSurface::Own {
    Surface surface;
    CGAL::AABB_tree<Traits> tree;
};

CgalSurface::CgalSurface(const Mesh& mesh) : own_(std::make_unique<Own>()) {
    for (const Vec3& p : mesh.positions) own_->surface.add_vertex(point(p));
    const auto at = [&](Index c) { return Surface::Vertex_index(mesh.vertex(c)); };
    for (Index f = 0; f < mesh.face_count(); ++f)
        own_->surface.add_face(at(3 * f), at(3 * f + 1), at(3 * f + 2));
}
CgalSurface::~CgalSurface() = default;

std::size_t CgalSurface::self_intersections() const {
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections<CGAL::Parallel_tag>(own_->surface,
                                                                          std::back_inserter(found));
    return found.size();
}

void CgalSurface::build_tree() {
    own_->tree.clear();
    own_->tree.insert(faces(own_->surface).first, faces(own_->surface).second, own_->surface);
    own_->tree.build();
    own_->tree.accelerate_distance_queries();
}

double CgalSurface::distances(std::span<const Vec3> points) const {
    return parallel_reduce(
        points.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t i = begin; i < end; ++i)
                sum += std::sqrt(own_->tree.squared_distance(point(points[i])));
            return sum;
        },
        [](double a, double b) { return a + b; }, 1024);
}

std::size_t CgalSurface::met(std::span<const Vec3> points) const {
    return parallel_reduce(
        points.empty() ? 0 : points.size() - 1, std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i)
                count += own_->tree.do_intersect(Kernel::Segment_3(point(points[i]), point(points[i + 1])));
            return count;
        },
        [](std::size_t a, std::size_t b) { return a + b; }, 1024);
}

} // namespace facetmill::bench
