#include "compare/cgal_clip.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Surface_mesh.h>

namespace facetmill::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

} // namespace

struct CgalClip::Own {
    Surface surface;
};

CgalClip::CgalClip(const Mesh& triangles) : own_(std::make_unique<Own>()) {
    for (const Vec3& p : triangles.positions) own_->surface.add_vertex({p.x, p.y, p.z});
    const auto at = [&](Index c) { return Surface::Vertex_index(triangles.vertex(c)); };
    for (Index f = 0; f < triangles.face_count(); ++f)
        own_->surface.add_face(at(3 * f), at(3 * f + 1), at(3 * f + 2));
}
CgalClip::~CgalClip() = default;

void CgalClip::clip(const Vec3& normal, const Vec3& through) {
    const Kernel::Plane_3 plane(Kernel::Point_3(through.x, through.y, through.z),
                                Kernel::Vector_3(normal.x, normal.y, normal.z));
    CGAL::Polygon_mesh_processing::clip(own_->surface, plane, CGAL::parameters::clip_volume(true));
}

std::size_t CgalClip::face_count() const { return own_->surface.number_of_faces(); }

} // namespace facetmill::bench
