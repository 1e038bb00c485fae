#include "geometry/openmesh/decimate.hpp"

#include "base/error.hpp"
#include "mesh/aspect_ratio.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/ModRoundnessT.hh>

namespace facetmill {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Halfedges = OpenMesh::TriMesh_ArrayKernelT<Traits>;

Vec3 vec(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }

/// The input and results of our OpenMesh module.
struct Shared {
    std::vector<DecimatedVertex> roles{};
    std::vector<Index> face_of{}; ///< the input number of each face of the halfedge mesh
    std::vector<Vec3> normals{};  ///< normals of the input faces
    double least_cosine = 0; ///< least cosine of the angle between a face's normal and its original normal
    double max_aspect_ratio = 0; ///< limit for the aspect ratio of faces, if all had less; 0: no limit
    std::vector<Decimation> made{};
};

/// Allows a collapse if it removes a free vertex and makes no face flat. Faces must stay within the angle of
/// their original normal and within the limit of the aspect ratio (or get no worse). Records the collapses.
/// (OpenMesh's own module for normals uses acos, whose results depend on the machine.)
template <class MeshT>
class NotesT : public OpenMesh::Decimater::ModBaseT<MeshT> {
  public:
    DECIMATING_MODULE(NotesT, MeshT, Notes);
    explicit NotesT(MeshT& mesh) : Base(mesh, true) {}
    void share(Shared* shared) { shared_ = shared; }

    float collapse_priority(const CollapseInfo& ci) override {
        const auto role = [&](auto v) { return shared_->roles[static_cast<std::size_t>(v.idx())]; };
        const bool may = role(ci.v0) == DecimatedVertex::free && role(ci.v1) != DecimatedVertex::untouched;
        return float(may && keeps_facing(ci) && keeps_shape(ci) ? Base::LEGAL_COLLAPSE
                                                                : Base::ILLEGAL_COLLAPSE);
    }

    void preprocess_collapse(const CollapseInfo& ci) override {
        const auto side = ci.fl.is_valid() ? ci.fl : ci.fr;
        shared_->made.push_back({static_cast<Index>(ci.v1.idx()), static_cast<Index>(ci.v0.idx()),
                                 shared_->face_of[static_cast<std::size_t>(side.idx())]});
    }

  private:
    bool keeps_facing(const CollapseInfo& ci) {
        auto& mesh = Base::mesh();
        for (auto h = mesh.cvoh_iter(ci.v0); h.is_valid(); ++h) {
            const auto face = mesh.face_handle(*h);
            if (!face.is_valid() || face == ci.fl || face == ci.fr) continue;
            const Vec3 x = vec(mesh.point(mesh.to_vertex_handle(*h))),
                       y = vec(mesh.point(mesh.from_vertex_handle(mesh.prev_halfedge_handle(*h))));
            const Vec3 to = vec(ci.p1), area = cross(x - to, y - to);
            const double size = length(area);
            const double longest = std::max({dot(x - to, x - to), dot(y - to, y - to), dot(x - y, x - y)});
            if (!(size > 1e-5 * longest)) return false;
            const Vec3& given = shared_->normals[shared_->face_of[static_cast<std::size_t>(face.idx())]];
            if (dot(given, given) > 0 && !(dot(given, area) >= shared_->least_cosine * size)) return false;
        }
        return true;
    }

    /// Whether the worst aspect ratio of the faces around is within the limit, or no worse than before.
    bool keeps_shape(const CollapseInfo& ci) {
        if (!(shared_->max_aspect_ratio > 0)) return true;
        auto& mesh = Base::mesh();
        double before = 1, after = 1;
        for (auto h = mesh.cvoh_iter(ci.v0); h.is_valid(); ++h) {
            const auto face = mesh.face_handle(*h);
            if (!face.is_valid()) continue;
            const Vec3 x = vec(mesh.point(mesh.to_vertex_handle(*h))),
                       y = vec(mesh.point(mesh.from_vertex_handle(mesh.prev_halfedge_handle(*h))));
            before = std::max(before, aspect_ratio(vec(ci.p0), x, y));
            if (face != ci.fl && face != ci.fr) after = std::max(after, aspect_ratio(vec(ci.p1), x, y));
        }
        return after <= shared_->max_aspect_ratio || after < before;
    }

    Shared* shared_ = nullptr;
};

/// Builds the halfedges. Faces that halfedges cannot hold (non-manifold) are left out, with their vertices
/// unchanged.
void build(Halfedges& mesh, Shared& shared, std::span<const Vec3> at, std::span<const Index> tri) {
    ::omerr().disable();
    for (const Vec3& p : at) mesh.add_vertex({p.x, p.y, p.z});
    for (Index f = 0; f < tri.size() / 3; ++f) {
        const auto corner = [&](Index k) {
            return Halfedges::VertexHandle(static_cast<int>(tri[3 * f + k]));
        };
        const bool flat = corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0);
        const auto face = flat ? Halfedges::FaceHandle() : mesh.add_face(corner(0), corner(1), corner(2));
        if (face.is_valid())
            shared.face_of.push_back(f);
        else
            for (Index k = 0; k < 3; ++k) shared.roles[tri[3 * f + k]] = DecimatedVertex::untouched;
        const Vec3 &a = at[tri[3 * f]], &b = at[tri[3 * f + 1]], &c = at[tri[3 * f + 2]];
        shared.normals.push_back(normalised(cross(b - a, c - a)));
    }
    ::omerr().enable();
}

template <class Module>
using HandleOf = typename Module::Handle;

} // namespace

std::vector<Decimation> decimate(std::span<const Vec3> positions, std::span<const Index> triangles,
                                 std::span<const DecimatedVertex> roles,
                                 const SimplifyConstraints& constraints, const DecimationGoal& goal) {
    Shared shared{.roles = {roles.begin(), roles.end()},
                  .least_cosine = constraints.least_cosine,
                  .max_aspect_ratio = constraints.aspect_ratio};
    Halfedges mesh;
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    mesh.request_face_normals();
    build(mesh, shared, positions, triangles);
    mesh.update_face_normals();
    OpenMesh::Decimater::DecimaterT<Halfedges> decimater(mesh);
    HandleOf<OpenMesh::Decimater::ModQuadricT<Halfedges>> quadric;
    HandleOf<NotesT<Halfedges>> notes;
    HandleOf<OpenMesh::Decimater::ModRoundnessT<Halfedges>> roundness;
    HandleOf<OpenMesh::Decimater::ModHausdorffT<Halfedges>> hausdorff;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.add(notes);
    decimater.module(notes).share(&shared);
    if (constraints.roundness > 0) {
        decimater.add(roundness);
        decimater.module(roundness).set_min_roundness(constraints.roundness, true);
    }
    if (constraints.hausdorff > 0) {
        decimater.add(hausdorff);
        decimater.module(hausdorff).set_tolerance(constraints.hausdorff);
    }
    if (!decimater.initialize()) throw Error(ErrorKind::bug, "E-BUG", "OpenMesh's decimater did not start");
    const std::size_t left_out = triangles.size() / 3 - shared.face_of.size();
    decimater.decimate_to_faces(goal.vertices, goal.faces > left_out ? goal.faces - left_out : 0);
    return std::move(shared.made);
}

} // namespace facetmill
