#include "compare/cgal_peer.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#if __has_include(<CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_count_ratio_stop_predicate.h>)
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_count_ratio_stop_predicate.h>
#else
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#endif

namespace facetmill::bench {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
#if __has_include(<CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_count_ratio_stop_predicate.h>)
using StopBase = sms::Edge_count_ratio_stop_predicate<Surface>;
struct Stop : StopBase {
    Stop(double ratio, const Surface& s) : StopBase(ratio, s) {}
};
#else
using StopBase = sms::Count_ratio_stop_predicate<Surface>;
struct Stop : StopBase {
    Stop(double ratio, const Surface&) : StopBase(ratio) {}
};
#endif

struct CgalPeer::Own {
    Surface surface;
};

CgalPeer::CgalPeer(const Mesh& mesh) : own_(std::make_unique<Own>()) {
    for (const Vec3& p : mesh.positions) own_->surface.add_vertex({p.x, p.y, p.z});
    const auto at = [&](Index c) { return Surface::Vertex_index(mesh.vertex(c)); };
    for (Index f = 0; f < mesh.face_count(); ++f)
        own_->surface.add_face(at(3 * f), at(3 * f + 1), at(3 * f + 2));
}
CgalPeer::~CgalPeer() = default;

void CgalPeer::simplify(double ratio, bool quadric) {
    Surface& s = own_->surface;
    const Stop stop(ratio, s);
    if (quadric) {
        using Policies = sms::GarlandHeckbert_plane_policies<Surface, Kernel>;
        const Policies policies(s);
        sms::edge_collapse(
            s, stop, CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
    } else {
        sms::edge_collapse(s, stop,
                           CGAL::parameters::get_cost(sms::Edge_length_cost<Surface>())
                               .get_placement(sms::Midpoint_placement<Surface>()));
    }
}

Mesh CgalPeer::mesh() const {
    Mesh mesh;
    std::vector<Index> number(own_->surface.num_vertices() + own_->surface.number_of_removed_vertices());
    for (const auto v : own_->surface.vertices()) {
        number[v] = static_cast<Index>(mesh.positions.size());
        const auto& p = own_->surface.point(v);
        mesh.positions.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : own_->surface.faces())
        for (const auto v : own_->surface.vertices_around_face(own_->surface.halfedge(f)))
            mesh.corners.push_back(number[v]);
    return mesh;
}

} // namespace facetmill::bench
