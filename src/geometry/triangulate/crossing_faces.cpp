#include "geometry/triangulate/crossing_faces.hpp"

#include "base/math/predicates.hpp"
#include "geometry/cgal/triangulate_polygon.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "geometry/triangulate/triangulate.hpp"
#include "mesh/face.hpp"
#include "mesh/placement.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

namespace facetmill {

namespace {

Contours outline_of(const std::vector<Vec2>& ring) {
    Contours contours;
    contours.points = ring;
    const auto n = static_cast<Index>(ring.size());
    for (Index i = 0; i < n; ++i) contours.edges.push_back({i, (i + 1) % n, 1});
    return contours;
}

/// Whether the outline winds around points more than once or in both directions, or touches itself so that
/// its triangulation needs more vertices.
bool crosses(const std::vector<Vec2>& ring, polygon::Kind kind) {
    if (kind != polygon::Kind::complex) return kind == polygon::Kind::self_intersecting;
    return fill(outline_of(ring)).triangles.size() != ring.size() - 2;
}

/// Whether the diagonal from the first corner of a quad separates the other two corners, projected along the
/// axis nearest to its normal. Then no edges cross. So most faces need only two signs.
bool is_parted_quad(std::span<const Vec3> p) {
    if (p.size() != 4) return false;
    const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto side = [&](const Vec3& q) {
        return orientation_2d(p[0][u], p[0][v], p[2][u], p[2][v], q[u], q[v]);
    };
    return side(p[1]) * side(p[3]) < 0;
}

enum class CrossingKind : std::uint8_t { none, in_plane, in_no_plane };

CrossingKind crossing_of(std::span<const Vec3> corners) {
    if (corners.size() < 4 || is_parted_quad(corners)) return CrossingKind::none;
    const std::vector<Vec2> ring = polygon::flattened(corners);
    const polygon::Kind kind = polygon::classify(ring);
    if (!crosses(ring, kind)) return CrossingKind::none;
    if (is_planar(corners, polygon::plane_deviation(corners))) return CrossingKind::in_plane;
    // The two triangles of a skewed quad share only a diagonal, from every direction of view.
    const bool may_overlap = kind == polygon::Kind::self_intersecting && corners.size() > 4;
    return may_overlap ? CrossingKind::in_no_plane : CrossingKind::none;
}

Contours flat_outline(const Mesh& mesh, Index f) {
    std::vector<Vec3> corners;
    face_corners(mesh, f, corners);
    return outline_of(polygon::flattened(corners));
}

/// Faces whose outlines cross or touch themselves, except along bridges to holes.
struct Found {
    std::vector<Index> in_plane;
    std::size_t in_no_plane = 0; ///< projected along the axis nearest to their normal
};

Found find_crossing_faces(const Mesh& mesh) {
    Found found;
    if (mesh.all_triangles()) return found;
    std::vector<CrossingKind> crossings(mesh.face_count(), CrossingKind::none);
    parallel_chunks(mesh.face_count(), [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> corners;
        for (auto f = static_cast<Index>(begin); f < end; ++f) {
            if (mesh.face_size(f) < 4) continue;
            face_corners(mesh, f, corners);
            crossings[f] = crossing_of(corners);
        }
    });
    for (Index f = 0; f < crossings.size(); ++f) {
        if (crossings[f] == CrossingKind::in_plane) found.in_plane.push_back(f);
        found.in_no_plane += crossings[f] == CrossingKind::in_no_plane;
    }
    return found;
}

/// Adds vertices where the outlines of faces meet themselves, to all faces along their edges.
class OutlineSplitter {
  public:
    explicit OutlineSplitter(const Mesh& mesh) : mesh_(mesh), edges_(build_edges(mesh)) {}

    void add(Index f) {
        const Contours outline = flat_outline(mesh_, f);
        const Filling filling = fill(outline);
        const Index begin = mesh_.face_begin(f), n = mesh_.face_size(f);
        std::vector<std::vector<Index>> edges_at(
            filling.added.size()); // the face's edges, by their first corners
        for (Index e = 0; e < n; ++e)
            for (Index k = filling.path_offsets[e]; k < filling.path_offsets[e + 1]; ++k)
                if (filling.path[k] >= n) edges_at[filling.path[k] - n].push_back(begin + e);
        std::vector<Index> vertex_of(filling.added.size());
        for (std::size_t i = 0; i < vertex_of.size(); ++i) {
            const auto& added = filling.added[i];
            const Index c = begin + added.edge;
            const Provenance::Edge at{mesh_.vertex(c), mesh_.vertex(next_corner(mesh_, f, c)), added.t};
            vertex_of[i] = vertex_for(edges_at[i], at);
        }
        for (Index e = 0; e < n; ++e)
            for (Index k = filling.path_offsets[e]; k < filling.path_offsets[e + 1]; ++k) {
                const Index p = filling.path[k];
                const Vec2 at = p < n ? outline.points[p] : filling.added[p - n].at;
                const double t = along(outline.points[e], outline.points[(e + 1) % n], at);
                insert(begin + e, t, p < n ? mesh_.vertex(begin + p) : vertex_of[p - n]);
            }
    }

    Mesh run(AttributeChanges& changes) {
        if (insertions_.empty()) {
            changes = kept_changes(mesh_.attributes);
            return mesh_;
        }
        return insert_on_edges(mesh_, std::move(insertions_), added_, &changes);
    }

  private:
    static double along(const Vec2& a, const Vec2& b, const Vec2& p) {
        const Vec2 d = b - a;
        return std::abs(d.x) > std::abs(d.y) ? (p.x - a.x) / d.x : (p.y - a.y) / d.y;
    }

    /// The vertex for a crossing of two edges of the mesh. All faces that report the crossing share it.
    Index vertex_for(const std::vector<Index>& corners, const Provenance::Edge& at) {
        std::vector<Index> edges;
        edges.reserve(corners.size());
        for (const Index c : corners) edges.push_back(edges_.corner_edge[c]);
        std::sort(edges.begin(), edges.end());
        const auto next = static_cast<Index>(mesh_.vertex_count() + added_.size());
        const auto [found, fresh] = made_.try_emplace(std::move(edges), next);
        if (fresh) added_.push_back(at);
        return found->second;
    }

    void insert(Index corner, double t, Index vertex) {
        const Index e = edges_.corner_edge[corner];
        if (!(t > 0 && t < 1) || !done_.insert({e, vertex}).second) return;
        for (const Index c : edges_.corners_of(e))
            insertions_.push_back({c, mesh_.vertex(c) == mesh_.vertex(corner) ? t : 1 - t, vertex});
    }

    const Mesh& mesh_;
    EdgeTable edges_;
    std::map<std::vector<Index>, Index> made_;
    std::set<std::pair<Index, Index>> done_; ///< pairs of edge and vertex
    std::vector<Provenance::Edge> added_;
    std::vector<Insertion> insertions_;
};

using FaceTriangles =
    std::vector<std::array<Index, 3>>; ///< corners are numbered from the face's first corner

/// Whether the triangles are bounded by the face's edges, vertex by vertex.
bool bounded_by_face(const Mesh& mesh, Index f, const FaceTriangles& triangles) {
    std::map<std::pair<Index, Index>, int> chain;
    const auto count = [&](Index a, Index b, int times) {
        if (a != b) chain[{std::min(a, b), std::max(a, b)}] += a < b ? times : -times;
    };
    const Index begin = mesh.face_begin(f);
    for (Index c = begin; c < mesh.face_end(f); ++c)
        count(mesh.vertex(c), mesh.vertex(next_corner(mesh, f, c)), 1);
    for (const auto& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            count(mesh.vertex(begin + t[k]), mesh.vertex(begin + t[(k + 1) % 3]), -1);
    return std::all_of(chain.begin(), chain.end(), [](const auto& edge) { return edge.second == 0; });
}

/// Replaces faces by their fillings.
class FaceFiller {
  public:
    FaceFiller(const Mesh& mesh, CrossingFaces& out) : mesh_(mesh), edges_(build_edges(mesh)), out_(out) {}

    void run(const std::vector<Index>& faces) {
        std::map<Index, FaceTriangles> fillings;
        for (const Index f : faces)
            if (auto triangles = filling_of(f); !triangles.empty()) fillings[f] = std::move(triangles);
        MeshProvenance provenance;
        provenance.vertices.identity = provenance.wedges.identity = true;
        Mesh& m = out_.mesh.emplace();
        m.positions = mesh_.positions;
        m.wedge_vertex = mesh_.wedge_vertex;
        m.face_offsets = {0};
        const auto emit = [&](Index f, auto&& corners) {
            for (const Index c : corners) m.corners.push_back(mesh_.corners[c]);
            m.face_offsets.push_back(static_cast<Index>(m.corners.size()));
            provenance.faces.push_back(f);
        };
        std::vector<Index> corners;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const Index begin = mesh_.face_begin(f);
            if (const auto found = fillings.find(f); found != fillings.end()) {
                for (const auto& t : found->second)
                    emit(f, std::array{begin + t[0], begin + t[1], begin + t[2]});
                continue;
            }
            corners.clear();
            for (Index c = begin; c < mesh_.face_end(f); ++c) corners.push_back(c);
            emit(f, corners);
        }
        normalise_offsets(m);
        out_.changes = changes_in_sequence(out_.changes, inherit_attributes(m, mesh_, provenance));
        out_.filled = fillings.size();
        out_.fans += faces.size() - fillings.size();
    }

  private:
    /// Empty if the face cannot be filled without opening the surface.
    FaceTriangles filling_of(Index f) {
        const Filling filling = fill(flat_outline(mesh_, f));
        if (!filling.added.empty()) return {}; // edges cross again after rounding the crossings
        FaceTriangles once = filling.triangles;
        once.erase(std::unique(once.begin(), once.end()),
                   once.end()); // equal triangles are adjacent after sorting
        if (stands_alone(f))
            return once; // coincident corners may have several vertices: no neighbour is affected
        if (!bounded_by_face(mesh_, f, filling.triangles)) return {};
        out_.overlapping += once.size() != filling.triangles.size();
        return filling.triangles;
    }

    bool stands_alone(Index f) const {
        for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c)
            if (const Index e = edges_.corner_edge[c]; e != none && !of_one_face(e, f)) return false;
        return true;
    }
    bool of_one_face(Index e, Index f) const {
        const auto corners = edges_.corners_of(e);
        return std::all_of(corners.begin(), corners.end(),
                           [&](Index c) { return mesh_.face_begin(f) <= c && c < mesh_.face_end(f); });
    }

    const Mesh& mesh_;
    EdgeTable edges_;
    CrossingFaces& out_;
};

} // namespace

std::vector<std::array<Vec3, 3>> covering_triangles(std::span<const Vec3> corners) {
    std::vector<std::array<Vec3, 3>> covering;
    if (crossing_of(corners) != CrossingKind::in_plane) return covering;
    const std::vector<Vec2> flat = polygon::flattened(corners);
    const polygon::Ring ring = flat;
    const auto t = polygon::triangulate_rings(polygon::Rings(&ring, 1));
    const auto at = [&](Index i) {
        if (i < corners.size()) return corners[i];
        const auto& added = t.added[i - corners.size()];
        return mix(corners[added.edge], corners[(added.edge + 1) % corners.size()], added.t);
    };
    for (const auto& abc : t.triangles) covering.push_back({at(abc[0]), at(abc[1]), at(abc[2])});
    return covering;
}

double covered_area(std::span<const Vec3> corners) {
    double twice = 0;
    for (const auto& [a, b, c] : covering_triangles(corners)) twice += safe_length(cross(b - a, c - a));
    return twice > 0 ? twice / 2 : safe_length(polygon::area_vector(corners));
}

namespace {

CrossingFaces fill_found(const Mesh& mesh, const Found& found) {
    CrossingFaces out;
    out.fans = found.in_no_plane;
    if (found.in_plane.empty()) return out;
    OutlineSplitter splitter(mesh);
    for (const Index f : found.in_plane) splitter.add(f);
    const Mesh split = splitter.run(out.changes);
    const Found left = find_crossing_faces(split);
    out.fans = left.in_no_plane;
    FaceFiller(split, out).run(left.in_plane);
    return out;
}

} // namespace

CrossingFaces fill_crossing_faces(const Mesh& mesh) { return fill_found(mesh, find_crossing_faces(mesh)); }

std::size_t count_fans(const Mesh& mesh) {
    const Found found = find_crossing_faces(mesh);
    return found.in_plane.empty() ? found.in_no_plane : fill_found(bare(mesh), found).fans;
}

Mesh triangles_of(const Mesh& mesh) {
    const CrossingFaces faces = fill_crossing_faces(mesh);
    return triangulated(faces.mesh ? *faces.mesh : mesh);
}

Surface filled_surface(const Mesh& mesh) {
    const Found found = find_crossing_faces(mesh);
    if (found.in_plane.empty()) return surface_of(mesh);
    Mesh numbered = bare(mesh);
    std::vector<std::uint32_t> numbers(mesh.face_count());
    std::iota(numbers.begin(), numbers.end(), 0U);
    numbered.attributes.push_back({"face", Domain::face, Role::index, 1, false, std::move(numbers)});
    const CrossingFaces faces = fill_found(numbered, found);
    Surface surface = surface_of(*faces.mesh);
    const auto& face_before =
        std::get<std::vector<std::uint32_t>>(faces.mesh->find("face", Domain::face)->data);
    if (surface.faces.empty())
        surface.faces = face_before;
    else
        for (Index& f : surface.faces) f = face_before[f];
    return surface;
}

} // namespace facetmill
