#include "geometry/thicken.hpp"

#include "base/functions.hpp"
#include "base/parallel.hpp"
#include "geometry/closest_point.hpp"
#include "geometry/self_intersections.hpp"
#include "geometry/surface_normal.hpp"
#include "mesh/lineage.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

/// A symmetric 3 x 3 system a x = b, by cofactors.
struct System {
    double a[3][3] = {};
    Vec3 b;
    double weight = 0;

    /// Adds the wish n . x = 1.
    void add(const Vec3& n, double w) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) a[i][j] += w * n[i] * n[j];
            b[i] += w * n[i];
        }
        weight += w;
    }
    /// Nearest to what is wished; of all such x the one nearest to start (proximal steps, each solved
    /// exactly).
    Vec3 solve(Vec3 start) const {
        const double pull = 1e-4 * weight;
        const Vec3 r0{a[0][0] + pull, a[0][1], a[0][2]}, r1{a[1][0], a[1][1] + pull, a[1][2]},
            r2{a[2][0], a[2][1], a[2][2] + pull};
        const Vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
        const double det = dot(r0, c0);
        for (int step = 0; step < 4; ++step) {
            const Vec3 rhs = b + start * pull;
            start = (c0 * rhs.x + c1 * rhs.y + c2 * rhs.z) / det;
        }
        return start;
    }
};

/// The angle of face f at corner c.
double angle_at(const Mesh& mesh, Index f, Index c) {
    const Index before = c == mesh.face_begin(f) ? mesh.face_end(f) - 1 : c - 1;
    const Vec3 u = mesh.point(before) - mesh.point(c),
               v = mesh.point(next_corner(mesh, f, c)) - mesh.point(c);
    return arc_tangent(length(cross(u, v)), dot(u, v));
}

struct Directions {
    std::vector<Vec3> of_vertex; ///< where a vertex goes for a distance of 1
    std::size_t limited = 0, still = 0;
};

Directions directions(const Mesh& mesh, double limit) {
    const auto corners = corners_at_vertices(mesh);
    const auto faces = corner_faces(mesh);
    Directions d;
    d.of_vertex.resize(mesh.vertex_count());
    std::vector<std::uint8_t> kind(mesh.vertex_count(), 0); // 1: limited, 2: still
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        System system;
        Vec3 mean;
        for (const Index c : corners.of(static_cast<Index>(v))) {
            const Vec3 n = normalised(area_vector(mesh, faces[c]));
            const double angle = angle_at(mesh, faces[c], c);
            if (!(dot(n, n) > 0) || !(angle > 0)) continue;
            system.add(n, angle);
            mean += n * angle;
        }
        mean = normalised(mean);
        if (!(dot(mean, mean) > 0)) {
            kind[v] = 2;
            return;
        }
        Vec3 way = system.solve(mean);
        const double far = length(way);
        if (!(far <= limit)) way = far < HUGE_VAL ? way * (limit / far) : mean, kind[v] = 1;
        if (!(dot(way, mean) > 0)) way = mean, kind[v] = 1;
        d.of_vertex[v] = way;
    });
    d.limited = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 1));
    d.still = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 2));
    return d;
}

/// Turns the normals of the wedges from `first` on, and the handedness of their tangents.
void turn_wedges(Mesh& mesh, std::size_t first, Fates& fates) {
    for (auto& a : mesh.attributes) {
        if (a.domain != Domain::wedge || !(a.role == Role::normal || a.role == Role::tangent)) continue;
        for (std::size_t w = first; w < a.size(); ++w) {
            if (a.role == Role::normal)
                for (int c = 0; c < a.components; ++c) a.set_value(w, c, -a.value(w, c));
            else if (a.components == 4)
                a.set_value(w, 3, -a.value(w, 3));
        }
        for (auto& f : fates)
            if (f.attribute == a.name && f.domain == a.domain)
                f = {a.name, a.domain, Fate::Kind::recomputed, "turned on the back"};
    }
}

std::vector<Index> spelled_wedges(const Mesh& mesh) {
    if (mesh.has_seams()) return mesh.wedge_vertex;
    std::vector<Index> wedges(mesh.wedge_count());
    for (Index w = 0; w < wedges.size(); ++w) wedges[w] = w;
    return wedges;
}

/// The surface and its back, face by face; back_vertex says where each vertex is on the back.
struct Doubled {
    Mesh mesh;
    Descent descent; ///< complete but for what is added later
};

Doubled doubled(const Mesh& mesh, const std::vector<Index>& back_vertex,
                const std::vector<Index>& back_copies) {
    Doubled d;
    const auto wedges = spelled_wedges(mesh);
    const auto count = static_cast<Index>(wedges.size());
    d.mesh.positions = mesh.positions;
    for (const Index v : back_copies) d.mesh.positions.push_back(mesh.positions[v]);
    d.mesh.wedge_vertex = wedges;
    for (const Index v : wedges) d.mesh.wedge_vertex.push_back(back_vertex[v]);
    d.mesh.corners = mesh.corners;
    d.mesh.face_offsets = mesh.face_offsets;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        d.mesh.corners.push_back(count + mesh.corners[begin]);
        for (Index c = end - 1; c > begin; --c) d.mesh.corners.push_back(count + mesh.corners[c]);
        if (!mesh.all_triangles()) d.mesh.face_offsets.push_back(static_cast<Index>(d.mesh.corners.size()));
    }
    for (int side = 0; side < 2; ++side) {
        for (Index w = 0; w < count; ++w) d.descent.wedges.copies.push_back(w);
        for (Index f = 0; f < mesh.face_count(); ++f) d.descent.faces.push_back(f);
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) d.descent.vertices.copies.push_back(v);
    d.descent.vertices.copies.insert(d.descent.vertices.copies.end(), back_copies.begin(), back_copies.end());
    return d;
}

struct OpenEdge {
    Index corner, next, face;
};

std::vector<OpenEdge> open_edges(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<OpenEdge> open;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Index e = edges.corner_edge[c];
        if (e != none && edges.corners_of(e).size() == 1)
            open.push_back({c, next_corner(mesh, faces[c], c), faces[c]});
    }
    return open;
}

/// Walls between front and back; each has wedges of its own when the mesh has normals, which `normals` then
/// lists.
std::size_t add_walls(const Mesh& mesh, Doubled& d, std::vector<std::pair<Index, Vec3>>& normals) {
    const bool own = mesh.find("NORMAL", Domain::wedge) != nullptr;
    const auto back = static_cast<Index>(mesh.wedge_count());
    std::size_t added = 0;
    for (const OpenEdge& e : open_edges(mesh)) {
        const Index u = mesh.corners[e.corner], v = mesh.corners[e.next];
        std::array<Index, 4> ring{v, u, back + u, back + v};
        if (own) {
            const auto at = [&](std::size_t i) { return d.mesh.positions[d.mesh.vertex_of_wedge(ring[i])]; };
            const Vec3 normal = normalised(cross(at(2) - at(0), at(3) - at(1)));
            for (Index& w : ring) {
                d.descent.wedges.copies.push_back(w % back);
                d.mesh.wedge_vertex.push_back(d.mesh.wedge_vertex[w]);
                w = static_cast<Index>(d.mesh.wedge_vertex.size() - 1);
                normals.emplace_back(w, normal);
            }
        }
        if (mesh.all_triangles()) {
            add_face(d.mesh, std::array{ring[0], ring[1], ring[2]});
            add_face(d.mesh, std::array{ring[0], ring[2], ring[3]});
            d.descent.faces.insert(d.descent.faces.end(), {e.face, e.face}), added += 2;
        } else {
            add_face(d.mesh, ring);
            d.descent.faces.push_back(e.face), ++added;
        }
    }
    return added;
}

/// Distances from the front's vertices and the middles of its faces to the back.
void measure(const Mesh& solid, const Mesh& surface, ThickenResult& r) {
    Mesh back;
    back.positions = solid.positions, back.wedge_vertex = solid.wedge_vertex;
    back.corners.assign(solid.corners.begin() + static_cast<std::ptrdiff_t>(surface.corner_count()),
                        solid.corners.begin() + static_cast<std::ptrdiff_t>(2 * surface.corner_count()));
    back.face_offsets = surface.face_offsets;
    const FaceTree tree(surface_of(back));
    std::vector<Vec3> points(solid.positions.begin(),
                             solid.positions.begin() + static_cast<std::ptrdiff_t>(surface.vertex_count()));
    for (Index f = 0; f < surface.face_count(); ++f) {
        Vec3 middle;
        for (Index c = solid.face_begin(f); c < solid.face_end(f); ++c) middle += solid.point(c);
        points.push_back(middle / solid.face_size(f));
    }
    double sum = 0, least = HUGE_VAL;
    std::size_t count = 0;
    for (const auto& c : closest_points(tree, points))
        if (c.distance < HUGE_VAL) sum += c.distance, least = std::min(least, c.distance), ++count;
    if (count > 0) r.mean = sum / static_cast<double>(count), r.thinnest = least;
}

} // namespace

ThickenResult thicken(const Mesh& mesh, const ThickenSettings& s) {
    ThickenResult r;
    const auto n = static_cast<Index>(mesh.vertex_count());
    std::vector<Index> back(n), copies(n);
    for (Index v = 0; v < n; ++v) back[v] = n + v, copies[v] = v;
    Doubled d = doubled(mesh, back, copies);
    const Directions ways = directions(mesh, s.corner_limit);
    const double out = s.side == ThickenSide::outward   ? s.thickness
                       : s.side == ThickenSide::centred ? s.thickness / 2
                                                        : 0;
    parallel_for(n, [&](std::size_t v) {
        d.mesh.positions[v] += ways.of_vertex[v] * out;
        d.mesh.positions[n + v] += ways.of_vertex[v] * (out - s.thickness);
    });
    std::vector<std::pair<Index, Vec3>> wall_normals;
    r.wall_faces = add_walls(mesh, d, wall_normals);
    r.fates = inherit_attributes(d.mesh, mesh, d.descent);
    // Walls come after the back: their normals are set after those of the back are turned.
    turn_wedges(d.mesh, mesh.wedge_count(), r.fates);
    if (Attribute* normals = d.mesh.find("NORMAL", Domain::wedge))
        for (const auto& [w, normal] : wall_normals)
            for (int c = 0; c < 3; ++c) normals->set_value(w, c, normal[static_cast<std::size_t>(c)]);
    if (!mesh.has_seams() && wall_normals.empty()) d.mesh.wedge_vertex = {};
    r.limited = ways.limited, r.still = ways.still;
    if (mesh.face_count() > 0) measure(d.mesh, mesh, r);
    if (s.self_intersections) r.self_intersections = find_self_intersections(d.mesh, {.limit = 0}).count;
    r.mesh = std::move(d.mesh);
    return r;
}

TwoSidedResult two_sided(const Mesh& mesh) {
    std::vector<std::uint8_t> open(mesh.vertex_count(), 0);
    for (const OpenEdge& e : open_edges(mesh)) open[mesh.vertex(e.corner)] = open[mesh.vertex(e.next)] = 1;
    std::vector<Index> back(mesh.vertex_count()), copies;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        back[v] = open[v] ? v : static_cast<Index>(mesh.vertex_count() + copies.size());
        if (!open[v]) copies.push_back(v);
    }
    Doubled d = doubled(mesh, back, copies);
    TwoSidedResult r;
    const bool plain =
        !mesh.has_seams() && std::none_of(mesh.attributes.begin(), mesh.attributes.end(),
                                          [](const auto& a) { return a.domain == Domain::wedge; });
    if (plain) { // a vertex is all there is to a wedge
        for (Index& c : d.mesh.corners) c = d.mesh.wedge_vertex[c];
        d.mesh.wedge_vertex = {};
        d.descent.wedges = d.descent.vertices;
    }
    r.fates = inherit_attributes(d.mesh, mesh, d.descent);
    if (!plain) turn_wedges(d.mesh, mesh.wedge_count(), r.fates);
    r.mesh = std::move(d.mesh);
    return r;
}

} // namespace facetmill
