#include "oracle/cgal_oracle.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

namespace facetmill::oracle {

std::vector<std::pair<Index, Index>> self_intersections(const Mesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    Surface surface;
    for (const Vec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto v = [&](Index i) { return Surface::Vertex_index(mesh.vertex(3 * f + i)); };
        if (surface.add_face(v(0), v(1), v(2)) == Surface::null_face())
            throw std::runtime_error("not a manifold mesh");
    }
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    std::vector<std::pair<Index, Index>> pairs;
    for (const auto& [a, b] : found)
        if (a != b) pairs.emplace_back(std::min<Index>(a, b), std::max<Index>(a, b));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace facetmill::oracle
