#include "stage/reference_mesh.hpp"

#include "geometry/triangulate/crossing_faces.hpp"
#include "io/flatten.hpp"
#include "mesh/transform.hpp"
#include "stage/read_recorded.hpp"

#include <fmt/format.h>

namespace facetmill {

ReferenceMesh::ReferenceMesh(const PathText& path, const Scene& scene, Context& context) {
    const Scene other = read_beside(path, scene, context);
    mesh_ = triangles_of(*io::WorldMesh(other));
    tree_ = std::make_unique<FaceTree>(surface_of(mesh_), FaceTree::Use::near);
    if (tree_->empty())
        throw Error(ErrorKind::stage, "E-REFERENCE",
                    fmt::format("{}: '{}' has no faces to take values from", context.name(), path.text),
                    "name a mesh file that has faces; for a point cloud, make a surface with wrap first");
}

std::optional<ReferenceMesh::Carried> ReferenceMesh::carried_to(const Part& part) const {
    const auto back = inverse(part.transform);
    if (!back) return {};
    Carried out{in_world(part), {}};
    out.sources = nearest_sources(mesh_, *tree_, out.mesh);
    inherit_attributes(out.mesh, mesh_, out.sources.provenance);
    apply(out.mesh, *back);
    return out;
}

} // namespace facetmill
