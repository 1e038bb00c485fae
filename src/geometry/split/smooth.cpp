#include "geometry/split/smooth.hpp"

#include "base/error.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/split/patterns.hpp"
#include "geometry/split/split.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

// The neighbourhoods for subdivision masks, on a manifold, oriented mesh.

/// Halfedges are corners: corner c runs from its vertex to the next corner's. A feature edge has one
/// face, or its two faces meet at more than the feature angle.
class SmoothRings {
  public:
    SmoothRings(const Mesh& mesh, const EdgeTable& edges, const SplitSettings& settings);

    const Mesh& mesh;
    const EdgeTable& edges;
    VertexLists corners; ///< corners at each vertex

    Index next(Index c) const { return next_[c]; }
    Index previous(Index c) const { return previous_[c]; }
    /// The corner that runs in the opposite direction, or none at a boundary.
    Index twin(Index c) const { return twin_[c]; }
    Index from(Index c) const { return mesh.vertex(c); }
    Index to(Index c) const { return mesh.vertex(next_[c]); }
    bool is_feature(Index e) const { return e == none || feature_[e]; }
    /// The feature edges at a vertex: their number, and the far ends of the first two.
    struct FeatureEdges {
        Index ends[2] = {none, none};
        int count = 0;
    };
    FeatureEdges features_at(Index v) const;
    bool is_boundary(Index e) const { return edges.corners_of(e).size() == 1; }
    /// Whether a smooth rule applies at the vertex: it is not on a boundary, and has fewer than two feature
    /// edges.
    bool is_smooth(Index v) const;

  private:
    std::vector<Index> next_, previous_, twin_;
    std::vector<std::uint8_t> feature_;
};

SmoothRings::SmoothRings(const Mesh& m, const EdgeTable& e, const SplitSettings& settings)
    : mesh(m), edges(e), corners(corners_at_vertices(m)), next_(m.corner_count()),
      previous_(m.corner_count()), twin_(m.corner_count(), none), feature_(e.size()) {
    const std::vector<Index> faces = corner_faces(mesh);
    parallel_for(mesh.corner_count(), [&](std::size_t i) {
        const auto c = static_cast<Index>(i);
        next_[c] = next_corner(mesh, faces[c], c);
        previous_[next_[c]] = c;
    });
    const double limit = settings.feature_angle ? cosine(*settings.feature_angle) : -2;
    const auto normal = [&](Index c) { return normalised(area_vector(mesh, faces[c], settings.to_world)); };
    parallel_for(edges.size(), [&](std::size_t i) {
        const auto at = edges.corners_of(static_cast<Index>(i));
        if (at.size() != 2) {
            feature_[i] = 1;
            return;
        }
        twin_[at[0]] = at[1];
        twin_[at[1]] = at[0];
        if (settings.feature_angle)
            feature_[i] = exceeds_feature_angle(dot(normal(at[0]), normal(at[1])), limit);
    });
}

SmoothRings::FeatureEdges SmoothRings::features_at(Index v) const {
    FeatureEdges features;
    const auto see = [&](Index c, Index end) {
        if (!is_feature(edges.corner_edge[c])) return;
        if (features.count < 2) features.ends[features.count] = end;
        ++features.count;
    };
    for (const Index c : corners.of(v)) {
        see(c, to(c));
        // The edge that ends at this vertex is another corner's own edge, unless it is a boundary.
        if (twin(previous(c)) == none) see(previous(c), from(previous(c)));
    }
    return features;
}

bool SmoothRings::is_smooth(Index v) const {
    for (const Index c : corners.of(v))
        if (twin(c) == none || twin(previous(c)) == none) return false;
    return features_at(v).count < 2;
}

/// The position of a vertex on a curve of feature edges, by the cubic B-spline's rule. None for corners and
/// ends, which stay.
std::optional<Vec3> on_curve(const SmoothRings& rings, Index v) {
    const auto features = rings.features_at(v);
    const auto& p = rings.mesh.positions;
    if (features.count < 2 && rings.is_smooth(v)) return {};
    if (features.count != 2) return p[v];
    return p[v] * 0.75 + (p[features.ends[0]] + p[features.ends[1]]) * 0.125;
}

Vec3 middle(const SmoothRings& rings, Index e) {
    const auto& [low, high] = rings.edges.edges[e];
    return (rings.mesh.positions[low] + rings.mesh.positions[high]) * 0.5;
}

/// The number of faces at a smooth vertex, and the sum of its neighbours.
struct Star {
    Index v;
    double n = 0;
    Vec3 sum{};

    Star(const SmoothRings& rings, Index vertex) : v(vertex) {
        for (const Index c : rings.corners.of(v)) {
            sum += rings.mesh.positions[rings.to(c)];
            ++n;
        }
    }
};

Vec3 loop_vertex(const SmoothRings& rings, Index v) {
    const Star star(rings, v);
    if (star.n == 0) return rings.mesh.positions[v];
    const double t = 3 + 2 * cosine(2 * pi / star.n), alpha = (40 - t * t) / 64;
    return rings.mesh.positions[v] * (1 - alpha) + star.sum * (alpha / star.n);
}

Vec3 loop_edge(const SmoothRings& rings, Index e) {
    const auto at = rings.edges.corners_of(e);
    const auto& [low, high] = rings.edges.edges[e];
    const auto& p = rings.mesh.positions;
    return (p[low] + p[high]) * 0.375 +
           (p[rings.from(rings.previous(at[0]))] + p[rings.from(rings.previous(at[1]))]) * 0.125;
}

/// The position (Q + R + (n - 2) P) / n. Q is the mean of the faces' centroids, and R the mean of the
/// neighbours.
Vec3 catmull_clark_vertex(const SmoothRings& rings, const std::vector<Index>& faces, Index v) {
    const Star star(rings, v);
    if (star.n == 0) return rings.mesh.positions[v];
    Vec3 centroids;
    for (const Index c : rings.corners.of(v)) centroids += corner_mean(rings.mesh, faces[c]);
    return (centroids + star.sum) / (star.n * star.n) + rings.mesh.positions[v] * ((star.n - 2) / star.n);
}

Vec3 catmull_clark_edge(const SmoothRings& rings, const std::vector<Index>& faces, Index e) {
    const auto at = rings.edges.corners_of(e);
    return middle(rings, e) * 0.5 +
           (corner_mean(rings.mesh, faces[at[0]]) + corner_mean(rings.mesh, faces[at[1]])) * 0.25;
}

/// The point beyond a on the curve of feature edges from b to a, mirrored if the curve ends at a.
Vec3 beyond(const SmoothRings& rings, Index a, Index b) {
    const auto& p = rings.mesh.positions;
    const auto features = rings.features_at(a);
    if (features.count == 2) return p[features.ends[0] == b ? features.ends[1] : features.ends[0]];
    return p[a] * 2 - p[b];
}

/// The vertex across the edge of corner c, mirrored at a feature edge: a wing of the eight-point mask. c
/// runs along a side of the triangle whose third vertex is `third`.
Vec3 wing(const SmoothRings& rings, Index c, Index third) {
    const auto& p = rings.mesh.positions;
    if (!rings.is_feature(rings.edges.corner_edge[c])) return p[rings.from(rings.previous(rings.twin(c)))];
    return p[rings.from(c)] + p[rings.to(c)] - p[third];
}

/// The mask of an irregular vertex a for its edge to b, corner c running from a to b.
Vec3 butterfly_irregular(const SmoothRings& rings, Index c) {
    const Index a = rings.from(c);
    const auto& p = rings.mesh.positions;
    const double n = Star(rings, a).n;
    Vec3 sum;
    double weights = 0;
    Index at = c;
    for (double j = 0; j < n; ++j, at = rings.twin(rings.previous(at))) {
        double w = (0.25 + cosine(2 * pi * j / n) + 0.5 * cosine(4 * pi * j / n)) / n;
        if (n == 3) w = j == 0 ? 5.0 / 12 : -1.0 / 12;
        if (n == 4) w = j == 0 ? 3.0 / 8 : j == 2 ? -1.0 / 8 : 0;
        sum += p[rings.to(at)] * w;
        weights += w;
    }
    return sum + p[a] * (1 - weights);
}

Vec3 butterfly_edge(const SmoothRings& rings, Index e) {
    const auto& p = rings.mesh.positions;
    const auto& [low, high] = rings.edges.edges[e];
    if (rings.is_feature(e))
        return (p[low] + p[high]) * (9.0 / 16) -
               (beyond(rings, low, high) + beyond(rings, high, low)) * (1.0 / 16);
    const auto at = rings.edges.corners_of(e);
    const auto irregular = [&](Index v) { return rings.is_smooth(v) && Star(rings, v).n != 6; };
    Vec3 sum;
    int masks = 0;
    for (const Index c : at) // the two runs start from different ends
        if (irregular(rings.from(c))) {
            sum += butterfly_irregular(rings, c);
            ++masks;
        }
    if (masks > 0) return sum / masks;
    const Index b0 = rings.from(rings.previous(at[0])), b1 = rings.from(rings.previous(at[1]));
    const auto wings = [&](Index c) {
        return wing(rings, rings.next(c), rings.from(c)) + wing(rings, rings.previous(c), rings.to(c));
    };
    return (p[low] + p[high]) * 0.5 + (p[b0] + p[b1]) * 0.125 - (wings(at[0]) + wings(at[1])) * (1.0 / 16);
}

/// Sets the new positions of the old vertices (vertex) and of the points on edges (edge) of a pattern with
/// one point per edge. Later points (centroids) stay.
template <class VertexRule, class EdgeRule>
void place(Mesh& finer, const SmoothRings& rings, VertexRule&& vertex, EdgeRule&& edge) {
    const std::size_t n = rings.mesh.vertex_count();
    parallel_for(n, [&](std::size_t v) { finer.positions[v] = vertex(static_cast<Index>(v)); });
    parallel_for(rings.edges.size(),
                 [&](std::size_t e) { finer.positions[n + e] = edge(static_cast<Index>(e)); });
}

Mesh loop_pass(const Mesh& mesh, const EdgeTable& table, const SmoothRings& rings,
               AttributeChanges& changes) {
    const EdgePoints points(mesh, table, 2);
    Mesh finer = apply_pattern(mesh, &points, QuadsPattern{true}, changes);
    place(
        finer, rings, [&](Index v) { return on_curve(rings, v).value_or(loop_vertex(rings, v)); },
        [&](Index e) { return rings.is_feature(e) ? middle(rings, e) : loop_edge(rings, e); });
    return finer;
}

Mesh butterfly_pass(const Mesh& mesh, const EdgeTable& table, const SmoothRings& rings,
                    AttributeChanges& changes) {
    const EdgePoints points(mesh, table, 2);
    Mesh finer = apply_pattern(mesh, &points, QuadsPattern{true}, changes);
    place(
        finer, rings, [&](Index v) { return mesh.positions[v]; },
        [&](Index e) { return butterfly_edge(rings, e); });
    return finer;
}

Mesh catmull_clark_pass(const Mesh& mesh, const EdgeTable& table, const SmoothRings& rings,
                        AttributeChanges& changes) {
    const EdgePoints points(mesh, table, 2);
    const std::vector<Index> faces = corner_faces(mesh);
    Mesh finer = apply_pattern(mesh, &points, QuadsPattern{}, changes);
    place(
        finer, rings,
        [&](Index v) { return on_curve(rings, v).value_or(catmull_clark_vertex(rings, faces, v)); },
        [&](Index e) {
            return rings.is_feature(e) ? middle(rings, e) : catmull_clark_edge(rings, faces, e);
        });
    return finer;
}

/// A triangle from each edge to the point inside its face. If the edge may turn, the triangle joins the
/// points inside the two adjacent faces instead. Odd passes cut faces at boundaries in three along the
/// boundary. The points of the boundary edge then replace the point inside.
struct Sqrt3Pattern {
    const SmoothRings& rings;
    const EdgePoints& points;
    std::vector<std::uint8_t> boundary; ///< [faces] the cut edge; 3: none
    std::vector<Index> before;          ///< [faces] the number of points inside earlier faces

    PatternCounts counts(const Mesh&, Index f) const {
        return boundary[f] < 3 ? PatternCounts{3, 9, 0, 0} : PatternCounts{3, 9, 1, 3};
    }
    bool triangles_only(const Mesh&) const { return true; }
    /// The third wedge of the triangle at the edge of corner c, which is not the cut boundary edge.
    Index third(const PatternFace& face, Index c) const {
        const Index f = c / 3, k = boundary[f];
        if (k == 3) return face.first_mix - before[face.face] + before[f];
        return points.wedge(3 * f + k, c == 3 * f + (k + 1) % 3 ? 2 : 1);
    }
    /// True unless the edge is a feature edge, a seam, or a boundary between primitives.
    bool may_turn(Index c) const {
        const Index twin = rings.twin(c);
        const Mesh& mesh = rings.mesh;
        return twin != none && !rings.is_feature(rings.edges.corner_edge[c]) &&
               mesh.corners[rings.next(twin)] == mesh.corners[c] &&
               mesh.corners[rings.next(c)] == mesh.corners[twin] &&
               mesh.primitive_of(twin / 3) == mesh.primitive_of(c / 3);
    }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index first = 3 * face.face, cut_at = boundary[face.face];
        if (cut_at == 3) centroid(face, out);
        for (Index k = 0; k < 3; ++k) {
            const Index c = first + k;
            if (k == cut_at)
                out.face(face.on(k, 1), face.on(k, 2), face.at((k + 2) % 3));
            else if (may_turn(c))
                out.face(face.at(k), third(face, rings.twin(c)), third(face, c));
            else
                out.face(face.at(k), face.at((k + 1) % 3), third(face, c));
        }
    }
};

Vec3 sqrt3_vertex(const SmoothRings& rings, Index v, bool odd) {
    const auto& p = rings.mesh.positions;
    if (!rings.is_smooth(v)) {
        const auto features = rings.features_at(v);
        if (!odd || features.count != 2) return p[v];
        return (p[v] * 19 + (p[features.ends[0]] + p[features.ends[1]]) * 4) / 27;
    }
    const Star star(rings, v);
    if (star.n == 0) return p[v];
    const double alpha = (4 - 2 * cosine(2 * pi / star.n)) / 9;
    return p[v] * (1 - alpha) + star.sum * (alpha / star.n);
}

Mesh sqrt3_pass(const Mesh& mesh, const EdgeTable& table, const SmoothRings& rings, bool odd,
                AttributeChanges& changes) {
    std::vector<std::uint8_t> cut(table.size()), boundary(mesh.face_count(), 3);
    std::vector<Index> before(mesh.face_count());
    Index centroids = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        for (std::uint8_t k = 0; odd && k < 3; ++k) // at most one edge of a face is cut
            if (boundary[f] == 3 && rings.twin(3 * f + k) == none) boundary[f] = k;
        if (boundary[f] < 3) cut[table.corner_edge[3 * f + boundary[f]]] = 1;
        before[f] = centroids;
        centroids += boundary[f] == 3;
    }
    const EdgePoints points(mesh, table, 3, cut);
    Mesh finer = apply_pattern(mesh, &points,
                               Sqrt3Pattern{rings, points, std::move(boundary), std::move(before)}, changes);
    const std::size_t n = mesh.vertex_count();
    parallel_for(
        n, [&](std::size_t v) { finer.positions[v] = sqrt3_vertex(rings, static_cast<Index>(v), odd); });
    const auto& p = mesh.positions;
    for (std::size_t e = 0, at = n; e < table.size(); ++e) {
        if (!cut[e]) continue;
        const auto& [low, high] = table.edges[e];
        finer.positions[at++] = (beyond(rings, low, high) + p[low] * 16 + p[high] * 10) / 27;
        finer.positions[at++] = (beyond(rings, high, low) + p[high] * 16 + p[low] * 10) / 27;
    }
    return finer;
}

[[noreturn]] void refuse(SplitMethod method, const std::string& found, const std::string& hint) {
    throw Error(ErrorKind::stage, "E-MANIFOLD",
                fmt::format("split: {} needs a manifold, oriented mesh; {}", to_string(method), found), hint);
}

} // namespace

void require_manifold(const Mesh& mesh, SplitMethod method) {
    const EdgeTable table = build_edges(mesh);
    for (Index e = 0; e < table.size(); ++e) {
        const auto at = table.corners_of(e);
        const auto& [low, high] = table.edges[e];
        if (at.size() > 2)
            refuse(method, fmt::format("the edge of vertices {} and {} has {} faces", low, high, at.size()),
                   "use clean to repair non-manifold edges and vertices, or the method midpoint, which "
                   "splits any mesh");
        if (at.size() == 2 && (mesh.vertex(at[0]) == low) == (mesh.vertex(at[1]) == low))
            refuse(method,
                   fmt::format("the faces at the edge of vertices {} and {} are oriented inconsistently", low,
                               high),
                   "use orient to make neighbouring faces consistent, or the method midpoint, which splits "
                   "any mesh");
    }
    for (Index c = 0; c < mesh.corner_count(); ++c)
        if (table.corner_edge[c] == none)
            refuse(method, fmt::format("a face uses vertex {} twice in a row", mesh.vertex(c)),
                   "clean removes degenerate faces");
    const auto fans = fans_at_vertices(mesh, table);
    for (Index v = 0; v < fans.size(); ++v)
        if (fans[v] > 1)
            refuse(method, fmt::format("{} fans of faces meet only at vertex {}", fans[v], v),
                   "use clean to repair non-manifold edges and vertices, or the method midpoint, which "
                   "splits any mesh");
}

Mesh split_smooth(const Mesh& mesh, const SplitSettings& settings, int pass, AttributeChanges& changes) {
    const EdgeTable table = build_edges(mesh);
    const SmoothRings rings(mesh, table, settings);
    Mesh finer;
    if (settings.method == SplitMethod::loop)
        finer = loop_pass(mesh, table, rings, changes);
    else if (settings.method == SplitMethod::butterfly)
        finer = butterfly_pass(mesh, table, rings, changes);
    else if (settings.method == SplitMethod::catmull_clark)
        finer = catmull_clark_pass(mesh, table, rings, changes);
    else
        finer = sqrt3_pass(mesh, table, rings, pass % 2 == 1, changes);
    changes = changes_in_sequence(changes, settle_moved(finer));
    return finer;
}

} // namespace facetmill
