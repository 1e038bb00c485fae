#pragma once
// A mesh as OpenMesh holds it, for a comparison side by side.

#include "mesh/mesh.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace facetmill::bench {

using OpenMeshTriangles = OpenMesh::TriMesh_ArrayKernelT<>;

/// A mesh of triangles.
inline OpenMeshTriangles to_openmesh(const Mesh& mesh) {
    OpenMeshTriangles theirs;
    for (const Vec3& p : mesh.positions)
        theirs.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    const auto vertex = [&](Index c) {
        return OpenMeshTriangles::VertexHandle(static_cast<int>(mesh.vertex(c)));
    };
    for (Index c = 0; c < mesh.corner_count(); c += 3)
        theirs.add_face(vertex(c), vertex(c + 1), vertex(c + 2));
    return theirs;
}

} // namespace facetmill::bench
