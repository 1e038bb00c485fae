#include "oracle/openmesh_oracle.hpp"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>

namespace facetmill::test {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Triangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

template <class Theirs>
Theirs theirs_of(const Mesh& mesh) {
    Theirs theirs;
    for (const Vec3& p : mesh.positions) theirs.add_vertex({p.x, p.y, p.z});
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<typename Theirs::VertexHandle> face;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            face.emplace_back(static_cast<int>(mesh.vertex(c)));
        theirs.add_face(face);
    }
    return theirs;
}

template <class Subdivider, class Theirs>
Mesh subdivided(const Mesh& mesh, int passes) {
    Theirs theirs = theirs_of<Theirs>(mesh);
    Subdivider subdivider;
    subdivider.attach(theirs);
    subdivider(static_cast<std::size_t>(passes));
    subdivider.detach();
    Mesh result;
    for (const auto v : theirs.vertices()) {
        const auto& p = theirs.point(v);
        result.positions.push_back({p[0], p[1], p[2]});
    }
    for (const auto f : theirs.faces()) {
        std::vector<Index> face;
        for (const auto v : theirs.fv_range(f)) face.push_back(static_cast<Index>(v.idx()));
        add_face(result, face);
    }
    return result;
}

} // namespace

Mesh openmesh_subdivided(const Mesh& mesh, SplitMethod method, int passes) {
    namespace Uniform = OpenMesh::Subdivider::Uniform;
    switch (method) {
    case SplitMethod::loop:
        return subdivided<Uniform::LoopT<Triangles>, Triangles>(mesh, passes);
    case SplitMethod::sqrt3:
        return subdivided<Uniform::Sqrt3T<Triangles>, Triangles>(mesh, passes);
    case SplitMethod::butterfly:
        return subdivided<Uniform::ModifiedButterflyT<Triangles>, Triangles>(mesh, passes);
    default:
        return subdivided<Uniform::CatmullClarkT<Polygons>, Polygons>(mesh, passes);
    }
}

} // namespace facetmill::test
