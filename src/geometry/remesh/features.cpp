#include "geometry/remesh/features.hpp"

#include "base/math/portable_math.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::remeshing {

namespace {

/// A flag during the layout: the edge is a feature only because of its angle.
constexpr std::uint8_t sharp = 8;

/// Lays out a mesh step by step.
class Layout {
  public:
    Layout(const Mesh& mesh, double feature_angle, double least_line)
        : mesh_(mesh), least_line_(least_line),
          least_cosine_(feature_angle >= pi ? -2 : cosine(feature_angle)) {}

    LaidOut run() {
        keep_faces_with_three_corners();
        work().points = mesh_.positions;
        work().flags.assign(work().corners.size(), 0);
        work().twins.assign(work().corners.size(), none);
        work().rings.assign(work().corners.size(), none);
        EdgeTable edges;
        {
            Mesh faces;
            faces.positions.resize(mesh_.vertex_count());
            faces.corners = work().corners;
            edges = build_edges(faces);
        }
        work().degrees.assign(mesh_.vertex_count(), 0);
        for (Index e = 0; e < edges.size(); ++e) add_edge(edges, e);
        forget_short_lines();
        set_regions();
        set_kinds();
        return std::move(out_);
    }

  private:
    WorkingMesh& work() { return out_.mesh; }

    void keep_faces_with_three_corners() {
        work().corners.reserve(mesh_.corner_count());
        source_.reserve(mesh_.face_count());
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const Index a = mesh_.vertex(3 * f), b = mesh_.vertex(3 * f + 1), c = mesh_.vertex(3 * f + 2);
            if (a == b || b == c || c == a) {
                ++out_.dropped_faces;
                continue;
            }
            work().corners.insert(work().corners.end(), {a, b, c});
            source_.push_back(f);
        }
        for (const Attribute& a : mesh_.attributes)
            if (a.domain == Domain::face && a.role == Role::index) borders_.push_back(&a);
    }

    /// The corner of the input for a half edge.
    Index corner(Index h) const { return 3 * source_[h / 3] + h % 3; }

    void add_edge(const EdgeTable& edges, Index e) {
        const auto sides = edges.corners_of(e);
        ++work().degrees[edges.edges[e].low];
        ++work().degrees[edges.edges[e].high];
        if (sides.size() == 1) {
            work().flags[sides[0]] = feature | seam;
            return;
        }
        const bool manifold = sides.size() == 2 && work().from(sides[0]) != work().from(sides[1]);
        if (!manifold) {
            ++out_.locked_edges;
            for (std::size_t i = 0; i < sides.size(); ++i) {
                work().flags[sides[i]] = feature | locked | seam;
                work().rings[sides[i]] = sides[(i + 1) % sides.size()];
            }
            return;
        }
        const Index h = sides[0], twin = sides[1];
        work().twins[h] = twin;
        work().twins[twin] = h;
        work().flags[h] = work().flags[twin] = flags_of(h, twin);
    }

    std::uint8_t flags_of(Index h, Index twin) const {
        const WorkingMesh& m = out_.mesh;
        const Index f = source_[h / 3], g = source_[twin / 3];
        const auto wedge = [&](Index half_edge) { return mesh_.corners[corner(half_edge)]; };
        if (wedge(h) != wedge(WorkingMesh::next(twin)) || wedge(WorkingMesh::next(h)) != wedge(twin))
            return feature | seam;
        for (const Attribute* a : borders_)
            for (int c = 0; c < a->components; ++c)
                if (a->value(f, c) != a->value(g, c)) return feature;
        const Vec3 n = normalised(m.face_normal(h / 3)), o = normalised(m.face_normal(twin / 3));
        const bool flat = !(dot(n, n) > 0) || !(dot(o, o) > 0); // without area there is no angle
        return !flat && exceeds_feature_angle(dot(n, o), least_cosine_) ? feature | sharp : 0;
    }

    void forget_short_lines() {
        WorkingMesh& m = work();
        DisjointSets lines(m.points.size());
        std::vector<double> lengths(m.points.size());
        const auto is_sharp = [&](Index h) { return (m.flags[h] & sharp) != 0 && m.stands(h); };
        for (Index h = 0; h < m.corners.size(); ++h)
            if (is_sharp(h)) lines.join(m.from(h), m.to(h));
        for (Index h = 0; h < m.corners.size(); ++h)
            if (is_sharp(h)) lengths[lines.find(m.from(h))] += m.edge_length(h);
        for (Index h = 0; h < m.corners.size(); ++h) {
            if (!(m.flags[h] & sharp)) continue;
            const bool is_short = lengths[lines.find(m.from(h))] < least_line_;
            m.flags[h] = is_short ? 0 : feature;
        }
    }

    void set_regions() {
        DisjointSets sets(work().face_slots());
        for (Index h = 0; h < work().corners.size(); ++h)
            if (!(work().flags[h] & feature)) sets.join(h / 3, work().twins[h] / 3);
        work().regions.resize(work().face_slots());
        out_.regions_of_faces.assign(mesh_.face_count(), none);
        for (Index f = 0; f < work().face_slots(); ++f)
            work().regions[f] = out_.regions_of_faces[source_[f]] = source_[sets.find(f)];
        for (Index f = 0; f < mesh_.face_count(); ++f) // each omitted face is a separate region
            if (out_.regions_of_faces[f] == none) out_.regions_of_faces[f] = f;
    }

    void set_kinds() {
        const std::size_t n = mesh_.vertex_count();
        WorkingMesh& m = work();
        m.kinds.assign(n, VertexKind::free);
        m.out.assign(n, none);
        std::vector<Index> corners_at(n), features_at(n);
        std::vector<std::uint8_t> is_locked(n);
        for (Index h = 0; h < m.corners.size(); ++h) {
            ++corners_at[m.from(h)];
            m.out[m.from(h)] = h;
            if (m.flags[h] & locked) is_locked[m.from(h)] = is_locked[m.to(h)] = 1;
            if (m.stands(h) && m.flags[h] & feature) {
                ++features_at[m.from(h)];
                ++features_at[m.to(h)];
            }
        }
        parallel_for(n, [&](std::size_t i) {
            const auto v = static_cast<Index>(i);
            if (m.out[v] == none) return;
            Index reached = 0;
            m.around(v, [&](Index) { return ++reached <= corners_at[v]; });
            if (is_locked[v] || reached != corners_at[v])
                m.kinds[v] = VertexKind::many;
            else if (features_at[v] > 0)
                m.kinds[v] = features_at[v] == 2 ? VertexKind::line : VertexKind::fixed;
        });
    }

    const Mesh& mesh_;
    double least_line_, least_cosine_;
    LaidOut out_;
    std::vector<Index> source_; ///< [faces of the working mesh] faces of the input
    std::vector<const Attribute*> borders_;
};

} // namespace

LaidOut lay_out(const Mesh& mesh, double feature_angle, double least_line) {
    return Layout(mesh, feature_angle, least_line).run();
}

} // namespace facetmill::remeshing
