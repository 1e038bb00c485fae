#include "geometry/triangulate/triangulate.hpp"

#include "base/math/predicates.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "mesh/placement.hpp"
#include "mesh/provenance.hpp"
#include "mesh/quad_diagonal.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

namespace {

using polygon::Kind;
using polygon::Ring;
using Triangle = std::array<Index, 3>; ///< corners are numbered from the face's first corner

int turn(const Vec2& a, const Vec2& b, const Vec2& c) { return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y); }

/// Whether the direction from p to x is in the sector that opens at p anticlockwise from out, up to and
/// excluding in.
bool in_sector(const Vec2& p, const Vec2& out, const Vec2& x, const Vec2& in) {
    const auto same = [&](const Vec2& a, const Vec2& b) {
        return turn(p, a, b) == 0 && dot(a - p, b - p) > 0;
    };
    if (same(x, out)) return true;
    if (same(out, in)) return true; // a spike has the full angle
    if (same(x, in)) return false;
    const bool after_out = turn(p, out, x) > 0, before_in = turn(p, x, in) > 0;
    return turn(p, out, in) > 0 ? after_out && before_in : after_out || before_in;
}

/// Cuts one face at a time, reusing its buffers.
class FaceCutter {
  public:
    FaceCutter(const Mesh& mesh, const QuadCuts& quads) : mesh_(mesh), quads_(quads) {}

    enum class How { whole, cut, fan };
    std::vector<Triangle> triangles;

    How cut(Index f) {
        const Index n = mesh_.face_size(f);
        triangles.clear();
        if (n == 3) {
            triangles.push_back({0, 1, 2});
            return How::whole;
        }
        face_corners(mesh_, f, corners_);
        flat_ = polygon::flattened(corners_);
        if (n == 4 && polygon::is_convex(flat_)) {
            quad(f);
            return How::cut;
        }
        if (delaunay()) return How::cut;
        triangles.clear();
        for (Index i = 1; i + 1 < n; ++i) triangles.push_back({0, i, i + 1});
        return How::fan;
    }

  private:
    void quad(Index f) {
        if (quads_.at_second[f])
            triangles = {{1, 2, 3}, {1, 3, 0}};
        else
            triangles = {{0, 1, 2}, {0, 2, 3}};
    }

    /// False if the corners do not wind around each enclosed point once, anticlockwise.
    bool delaunay() {
        const Ring ring = flat_;
        const auto t = polygon::triangulate_rings(polygon::Rings(&ring, 1));
        if (!t.added.empty() || t.triangles.size() != ring.size() - 2) return false;
        if (std::any_of(t.winding.begin(), t.winding.end(), [](int w) { return w != 1; })) return false;
        for (const auto& triangle : t.triangles)
            triangles.push_back({corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)});
        return true;
    }

    /// Among the corners that coincide with the triangle's k-th corner, returns the corner whose sector
    /// contains the triangle.
    Index corner(const Triangle& t, std::size_t k) const {
        const Vec2 &p = flat_[t[k]], &next = flat_[t[(k + 1) % 3]];
        const auto n = static_cast<Index>(flat_.size());
        for (Index c = t[k]; c < n; ++c)
            if (flat_[c] == p && in_sector(p, flat_[(c + 1) % n], next, flat_[(c + n - 1) % n])) return c;
        return t[k];
    }

    const Mesh& mesh_;
    const QuadCuts& quads_;
    std::vector<Vec3> corners_;
    std::vector<Vec2> flat_;
};

FaceKinds sum_of(FaceKinds a, const FaceKinds& b) {
    for (std::size_t k = 0; k < a.of_kind.size(); ++k) a.of_kind[k] += b.of_kind[k];
    a.non_planar += b.non_planar;
    if (b.deviation > a.deviation || a.worst == none) {
        a.deviation = b.deviation;
        a.worst = b.worst;
    }
    return a;
}

double perimeter(std::span<const Vec3> p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += length(p[(i + 1) % p.size()] - p[i]);
    return sum;
}

} // namespace

void face_corners(const Mesh& mesh, Index f, std::vector<Vec3>& corners) {
    corners.clear();
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) corners.push_back(mesh.point(c));
}

Kind face_kind(std::span<const Vec3> corners) {
    if (corners.size() != 3) return polygon::classify(polygon::flattened(corners));
    return collinear(corners[0], corners[1], corners[2]) ? Kind::degenerate : Kind::triangle;
}

bool is_planar(std::span<const Vec3> corners, double deviation, double planar) {
    return !(deviation > planar * perimeter(corners));
}

FaceKinds face_kinds(const Mesh& mesh, double planar) {
    return parallel_reduce(
        mesh.face_count(), FaceKinds{},
        [&](std::size_t begin, std::size_t end) {
            FaceKinds kinds;
            std::vector<Vec3> corners;
            for (std::size_t i = begin; i < end; ++i) {
                const auto f = static_cast<Index>(i);
                face_corners(mesh, f, corners);
                ++kinds.of_kind[static_cast<std::size_t>(face_kind(corners))];
                const double deviation = polygon::plane_deviation(corners);
                kinds.non_planar += !is_planar(corners, deviation, planar);
                if (kinds.worst == none || deviation > kinds.deviation) {
                    kinds.deviation = deviation;
                    kinds.worst = f;
                }
            }
            return kinds;
        },
        sum_of, 1024);
}

FaceKinds face_kinds(const Scene& scene, double planar) {
    FaceKinds all;
    for (const Part& part : scene.parts)
        all = sum_of(all, part.transform.identity() ? face_kinds(part.mesh, planar)
                                                    : face_kinds(in_world(part), planar));
    all.worst = none;
    return all;
}

TriangulateResult triangulate(const Mesh& mesh) {
    TriangulateResult result;
    result.kinds = face_kinds(mesh);
    std::vector<Index> first(mesh.face_count());
    for (Index f = 0; f < first.size(); ++f) first[f] = mesh.face_size(f) - 2;
    const Index count = exclusive_scan(first);
    const QuadCuts quads = mesh.all_triangles() ? QuadCuts{} : quad_cuts(mesh);
    Mesh& out = result.mesh;
    out.positions = mesh.positions;
    out.wedge_vertex = mesh.wedge_vertex;
    out.corners.resize(std::size_t{count} * 3);
    MeshProvenance provenance;
    provenance.vertices.identity = provenance.wedges.identity = true;
    provenance.faces.resize(count);
    struct Counts {
        std::size_t cut = 0, fan = 0;
    };
    const Counts counts = parallel_reduce(
        mesh.face_count(), Counts{},
        [&](std::size_t begin, std::size_t end) {
            Counts here;
            FaceCutter cutter(mesh, quads);
            for (std::size_t i = begin; i < end; ++i) {
                const auto f = static_cast<Index>(i);
                const auto how = cutter.cut(f);
                here.cut += how != FaceCutter::How::whole;
                here.fan += how == FaceCutter::How::fan;
                Index at = first[f];
                for (const Triangle& t : cutter.triangles) {
                    for (std::size_t k = 0; k < 3; ++k)
                        out.corners[std::size_t{at} * 3 + k] = mesh.corners[mesh.face_begin(f) + t[k]];
                    provenance.faces[at++] = f;
                }
            }
            return here;
        },
        [](Counts a, const Counts& b) {
            return Counts{a.cut + b.cut, a.fan + b.fan};
        },
        1024);
    result.cut = counts.cut;
    result.fans = counts.fan;
    result.changes = inherit_attributes(out, mesh, provenance);
    return result;
}

} // namespace facetmill
