#include "oracle/cgal_oracle.hpp"

// GCC 12 suspects Polygon_2's own iterators once they are inlined.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_triangle_primitive_3.h>)
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

namespace facetmill::oracle {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

Surface surface_of(const Mesh& mesh) {
    Surface surface;
    for (const Vec3& p : mesh.positions) surface.add_vertex(point(p));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto v = [&](Index i) { return Surface::Vertex_index(mesh.vertex(3 * f + i)); };
        if (surface.add_face(v(0), v(1), v(2)) == Surface::null_face())
            throw std::runtime_error("not a manifold mesh");
    }
    return surface;
}

} // namespace

std::vector<std::pair<Index, Index>> self_intersections(const Mesh& mesh) {
    const Surface surface = surface_of(mesh);
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    std::vector<std::pair<Index, Index>> pairs;
    for (const auto& [a, b] : found)
        if (a != b) pairs.emplace_back(std::min<Index>(a, b), std::max<Index>(a, b));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
    const auto at = [](const Vec3& p) { return Exact::Point_3(p.x, p.y, p.z); };
    return CGAL::orientation(at(a), at(b), at(c), at(d));
}

double hausdorff_distance(const Mesh& from, const Mesh& to, double error) {
    return CGAL::Polygon_mesh_processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
        surface_of(from), surface_of(to), error);
}

namespace {

Mesh mesh_of(Surface surface) {
    surface.collect_garbage();
    Mesh mesh;
    for (const auto v : surface.vertices())
        mesh.positions.push_back({surface.point(v).x(), surface.point(v).y(), surface.point(v).z()});
    for (const auto f : surface.faces())
        for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
            mesh.corners.push_back(static_cast<Index>(v));
    return mesh;
}

} // namespace

Mesh union_of(const Mesh& a, const Mesh& b) {
    Surface of_a = surface_of(a), of_b = surface_of(b), joined;
    if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(of_a, of_b, joined))
        throw std::runtime_error("no union");
    return mesh_of(std::move(joined));
}

Mesh difference_of(const Mesh& a, const Mesh& b) {
    Surface of_a = surface_of(a), of_b = surface_of(b), left;
    if (!CGAL::Polygon_mesh_processing::corefine_and_compute_difference(of_a, of_b, left))
        throw std::runtime_error("no difference");
    return mesh_of(std::move(left));
}

namespace {

using Triangles = std::vector<Kernel::Triangle_3>;
#if __has_include(<CGAL/AABB_triangle_primitive_3.h>)
using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>;
using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

} // namespace

struct Tree::Own {
    Triangles triangles;
    CGAL::AABB_tree<Traits> tree;
};

Tree::Tree(const Mesh& mesh) : own_(std::make_unique<Own>()) {
    for (Index c = 0; c < mesh.corners.size(); c += 3)
        own_->triangles.emplace_back(point(mesh.point(c)), point(mesh.point(c + 1)),
                                     point(mesh.point(c + 2)));
    own_->tree.insert(own_->triangles.cbegin(), own_->triangles.cend());
    own_->tree.build();
}
Tree::~Tree() = default;

double Tree::distance(const Vec3& p) const { return std::sqrt(own_->tree.squared_distance(point(p))); }

std::size_t Tree::met_by(const Vec3& from, const Vec3& to) const {
    return own_->tree.number_of_intersected_primitives(Kernel::Segment_3(point(from), point(to)));
}

struct Polygon::Own {
    CGAL::Polygon_2<Kernel> ring;
};

Polygon::Polygon(polygon::Ring ring) : own_(std::make_unique<Own>()) {
    for (const Vec2& p : ring) own_->ring.push_back({p.x, p.y});
}
Polygon::~Polygon() = default;

double Polygon::area() const { return own_->ring.area(); }
bool Polygon::is_simple() const { return own_->ring.is_simple(); }
bool Polygon::is_convex() const { return own_->ring.is_convex(); }
int Polygon::orientation() const { return own_->ring.orientation(); }
int Polygon::side(const Vec2& p) const { return own_->ring.bounded_side({p.x, p.y}); }

} // namespace facetmill::oracle
