// Simplification under constraints: OpenMesh's decimater with its quadric, aspect-ratio, roundness and
// Hausdorff modules, and two of our own. Each collapse goes into our log, so attributes follow as for the
// other methods.

#include "base/error.hpp"
#include "geometry/simplify/work.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModAspectRatioT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/ModRoundnessT.hh>

namespace facetmill::simplification {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Halfedges = OpenMesh::TriMesh_ArrayKernelT<Traits>;

Vec3 vec(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }

/// What both modules of ours know.
struct Shared {
    Work* work = nullptr;
    std::vector<Index> face_of;       ///< of the work, by face of the halfedges
    std::vector<Vec3> normals;        ///< of the faces as they came
    std::vector<std::uint8_t> pinned; ///< vertices that take part in no collapse
    double least_cosine = 0;          ///< of a face's normal and the one that it had
};

/// Allows a collapse when it removes a free vertex, keeps the faces within the angle of the normal that they
/// came with, and makes none flat. Logs what is made. (OpenMesh's own module for normals uses acos, whose
/// results depend on the machine.)
template <class MeshT>
class LogT : public OpenMesh::Decimater::ModBaseT<MeshT> {
  public:
    DECIMATING_MODULE(LogT, MeshT, Log);
    explicit LogT(MeshT& mesh) : Base(mesh, true) {}
    void share(Shared* shared) { shared_ = shared; }

    float collapse_priority(const CollapseInfo& ci) override {
        const Work& s = *shared_->work;
        const auto removed = static_cast<Index>(ci.v0.idx()), kept = static_cast<Index>(ci.v1.idx());
        const bool limited = !s.limit.empty() && std::min(s.limit[removed], s.limit[kept]) < never;
        if (s.kind[removed] != Kind::smooth || limited || shared_->pinned[removed] || shared_->pinned[kept])
            return float(Base::ILLEGAL_COLLAPSE);
        auto& mesh = Base::mesh();
        for (auto h = mesh.cvoh_iter(ci.v0); h.is_valid(); ++h) {
            const auto face = mesh.face_handle(*h);
            if (!face.is_valid() || face == ci.fl || face == ci.fr) continue;
            const Vec3 x = vec(mesh.point(mesh.to_vertex_handle(*h))),
                       y = vec(mesh.point(mesh.from_vertex_handle(mesh.prev_halfedge_handle(*h))));
            const Vec3 to = vec(ci.p1), area = cross(x - to, y - to);
            const double size = length(area);
            const double longest = std::max({dot(x - to, x - to), dot(y - to, y - to), dot(x - y, x - y)});
            if (!(size > 1e-5 * longest)) return float(Base::ILLEGAL_COLLAPSE);
            const Vec3& given = shared_->normals[shared_->face_of[static_cast<std::size_t>(face.idx())]];
            if (dot(given, given) > 0 && !(dot(given, area) >= shared_->least_cosine * size))
                return float(Base::ILLEGAL_COLLAPSE);
        }
        return float(Base::LEGAL_COLLAPSE);
    }

    void preprocess_collapse(const CollapseInfo& ci) override {
        Work& s = *shared_->work;
        const auto b = static_cast<Index>(ci.v0.idx()), a = static_cast<Index>(ci.v1.idx());
        if (!s.wedge.empty()) hand_over_wedges(ci, b, a);
        auto& mesh = Base::mesh();
        for (auto f = mesh.cvf_iter(ci.v0); f.is_valid(); ++f) s.tri[corner_at(*f, b)] = a;
        s.log.steps.push_back(
            {s.source[a], s.source[b], static_cast<Index>(s.log.wedges.size()), 0, s.at[a]});
    }

  private:
    using Face = typename MeshT::FaceHandle;

    Index corner_at(Face face, Index v) const {
        const Index c = 3 * shared_->face_of[static_cast<std::size_t>(face.idx())];
        const Work& s = *shared_->work;
        return s.tri[c] == v ? c : s.tri[c + 1] == v ? c + 1 : c + 2;
    }
    void hand_over_wedges(const CollapseInfo& ci, Index b, Index a) {
        Work& s = *shared_->work;
        const Face side = ci.fl.is_valid() ? ci.fl : ci.fr;
        const Index to = s.wedge[corner_at(side, a)], from = s.wedge[corner_at(side, b)];
        if (to == from) return;
        s.log.wedges.push_back({to, from});
        auto& mesh = Base::mesh();
        for (auto f = mesh.cvf_iter(ci.v0); f.is_valid(); ++f) s.wedge[corner_at(*f, b)] = to;
    }

    Shared* shared_ = nullptr;
};

/// Builds the halfedges; what they cannot hold (non-manifold places) stays out, and its vertices as they are.
void build(Halfedges& mesh, Shared& shared) {
    const Work& s = *shared.work;
    shared.pinned.resize(s.vertex_slots());
    ::omerr().disable();
    for (const Vec3& p : s.at) mesh.add_vertex({p.x, p.y, p.z});
    for (Index f = 0; f < s.face_slots(); ++f) {
        const auto at = [&](Index k) { return Halfedges::VertexHandle(static_cast<int>(s.tri[3 * f + k])); };
        const bool flat = at(0) == at(1) || at(1) == at(2) || at(2) == at(0);
        const auto face = flat ? Halfedges::FaceHandle() : mesh.add_face(at(0), at(1), at(2));
        if (face.is_valid())
            shared.face_of.push_back(f);
        else
            for (Index k = 0; k < 3; ++k) shared.pinned[s.tri[3 * f + k]] = 1;
        const Vec3 &a = s.at[s.tri[3 * f]], &b = s.at[s.tri[3 * f + 1]], &c = s.at[s.tri[3 * f + 2]];
        shared.normals.push_back(normalised(cross(b - a, c - a)));
    }
    ::omerr().enable();
    for (std::size_t v = 0; v < s.vertex_slots(); ++v) shared.pinned[v] |= s.kind[v] == Kind::pinned;
}

template <class Module>
using HandleOf = typename Module::Handle;

} // namespace

Outcome run_constrained(Work& s, std::size_t vertices, const Goal& goal,
                        const SimplifyConstraints& constraints) {
    const Origin origin(s, vertices);
    Shared shared;
    shared.work = &s, shared.least_cosine = constraints.least_cosine;
    Halfedges mesh;
    mesh.request_vertex_status(), mesh.request_edge_status(), mesh.request_halfedge_status();
    mesh.request_face_status(), mesh.request_face_normals();
    build(mesh, shared);
    mesh.update_face_normals();
    OpenMesh::Decimater::DecimaterT<Halfedges> decimater(mesh);
    HandleOf<OpenMesh::Decimater::ModQuadricT<Halfedges>> quadric;
    HandleOf<LogT<Halfedges>> log;
    HandleOf<OpenMesh::Decimater::ModAspectRatioT<Halfedges>> aspect;
    HandleOf<OpenMesh::Decimater::ModRoundnessT<Halfedges>> roundness;
    HandleOf<OpenMesh::Decimater::ModHausdorffT<Halfedges>> hausdorff;
    decimater.add(quadric), decimater.module(quadric).unset_max_err();
    decimater.add(log), decimater.module(log).share(&shared);
    if (constraints.aspect_ratio > 0)
        decimater.add(aspect),
            decimater.module(aspect).set_aspect_ratio(static_cast<float>(constraints.aspect_ratio));
    if (constraints.roundness > 0)
        decimater.add(roundness), decimater.module(roundness).set_min_roundness(constraints.roundness, true);
    if (constraints.hausdorff > 0)
        decimater.add(hausdorff), decimater.module(hausdorff).set_tolerance(constraints.hausdorff * s.scale);
    const std::size_t left_out = s.face_slots() - shared.face_of.size();
    if (!decimater.initialize()) throw Error(ErrorKind::bug, "E-BUG", "OpenMesh's decimater did not start");
    decimater.decimate_to_faces(goal.vertices, goal.faces > left_out ? goal.faces - left_out : 0);
    Outcome out;
    out.collapses = s.log.steps.size(), out.passes = 1;
    roll_back(s, origin, s.log.steps.size());
    out.stuck = s.live_faces > goal.faces && s.live_vertices > goal.vertices;
    return out;
}

} // namespace facetmill::simplification
