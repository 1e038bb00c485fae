#include "geometry/thicken/thicken.hpp"

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/thicken/doubled.hpp"
#include "mesh/face.hpp"
#include "mesh/inverse.hpp"
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

/// The angle of face f at corner c, in world.
double angle_at(const Mesh& mesh, Index f, Index c, const Transform& to_world) {
    const Vec3 u = to_world.vector(mesh.point(previous_corner(mesh, f, c)) - mesh.point(c)),
               v = to_world.vector(mesh.point(next_corner(mesh, f, c)) - mesh.point(c));
    return arc_tangent(length(cross(u, v)), dot(u, v));
}

struct Directions {
    std::vector<Vec3> of_vertex; ///< where a vertex goes for a distance of 1 in world
    std::size_t limited = 0, still = 0;
};

Directions directions(const Mesh& mesh, double limit, const Transform& to_world) {
    const Transform back = inverse(to_world).value_or(Transform{});
    const double front = to_world.determinant() < 0 ? -1 : 1; // faces of a mirrored part keep their front
    const auto corners = corners_at_vertices(mesh);
    const auto faces = corner_faces(mesh);
    Directions d;
    d.of_vertex.resize(mesh.vertex_count());
    std::vector<std::uint8_t> kind(mesh.vertex_count(), 0); // 1: limited, 2: still
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        System system;
        Vec3 mean;
        for (const Index c : corners.of(static_cast<Index>(v))) {
            const Vec3 n = normalised(area_vector(mesh, faces[c], to_world)) * front;
            const double angle = angle_at(mesh, faces[c], c, to_world);
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
        if (!(far <= limit)) {
            way = far < HUGE_VAL ? way * (limit / far) : mean;
            kind[v] = 1;
        }
        if (!(dot(way, mean) > 0)) {
            way = mean;
            kind[v] = 1;
        }
        d.of_vertex[v] = back.vector(way);
    });
    d.limited = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 1));
    d.still = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 2));
    return d;
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
            d.descent.faces.insert(d.descent.faces.end(), {e.face, e.face});
            added += 2;
        } else {
            add_face(d.mesh, ring);
            d.descent.faces.push_back(e.face);
            ++added;
        }
    }
    return added;
}

/// Distances from the front's vertices and the middles of its faces to the back, in world.
void measure(const Mesh& solid, const Mesh& surface, const Transform& to_world, ThickenResult& r) {
    Mesh back;
    back.positions = solid.positions;
    back.wedge_vertex = solid.wedge_vertex;
    for (Vec3& p : back.positions) p = to_world.point(p);
    back.corners.assign(solid.corners.begin() + static_cast<std::ptrdiff_t>(surface.corner_count()),
                        solid.corners.begin() + static_cast<std::ptrdiff_t>(2 * surface.corner_count()));
    back.face_offsets = surface.face_offsets;
    const FaceTree tree(surface_of(back));
    std::vector<Vec3> points(back.positions.begin(),
                             back.positions.begin() + static_cast<std::ptrdiff_t>(surface.vertex_count()));
    for (Index f = 0; f < surface.face_count(); ++f) {
        Vec3 middle;
        for (Index c = solid.face_begin(f); c < solid.face_end(f); ++c)
            middle += to_world.point(solid.point(c));
        points.push_back(middle / solid.face_size(f));
    }
    double sum = 0, least = HUGE_VAL;
    std::size_t count = 0;
    for (const auto& c : closest_points(tree, points))
        if (c.distance < HUGE_VAL) {
            sum += c.distance;
            least = std::min(least, c.distance);
            ++count;
        }
    if (count > 0) {
        r.mean = sum / static_cast<double>(count);
        r.thinnest = least;
    }
}

/// The diagonal of the box around all vertices, in world.
double size_of(const Mesh& mesh, const Transform& to_world) {
    Box box;
    for (const Vec3& p : mesh.positions) box.add(to_world.point(p));
    return box.empty() ? 0 : length(box.max - box.min);
}

/// Edges along which more faces run one way than the other.
std::size_t unbalanced_edges(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    std::size_t count = 0;
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
        count += balance != 0;
    }
    return count;
}

} // namespace

namespace {

ThickenResult thicken_sheets(const Mesh& mesh, const ThickenSettings& s) {
    ThickenResult r;
    const auto n = static_cast<Index>(mesh.vertex_count());
    std::vector<Index> back(n), copies(n);
    for (Index v = 0; v < n; ++v) {
        back[v] = n + v;
        copies[v] = v;
    }
    Doubled d = doubled(mesh, back, copies);
    const Directions ways = directions(mesh, s.miter_limit, s.to_world);
    const double out = s.side == ThickenSide::outward   ? s.thickness
                       : s.side == ThickenSide::centred ? s.thickness / 2
                                                        : 0;
    parallel_for(n, [&](std::size_t v) {
        d.mesh.positions[v] += ways.of_vertex[v] * out;
        d.mesh.positions[n + v] += ways.of_vertex[v] * (out - s.thickness);
    });
    std::vector<std::pair<Index, Vec3>> wall_normals;
    r.wall_faces = add_walls(mesh, d, wall_normals);
    r.changes = inherit_attributes(d.mesh, mesh, d.descent);
    // Walls come after the back: their normals are set after those of the back are turned.
    turn_wedges(d.mesh, mesh.wedge_count(), r.changes);
    if (Attribute* normals = d.mesh.find("NORMAL", Domain::wedge))
        for (const auto& [w, normal] : wall_normals)
            for (int c = 0; c < 3; ++c) normals->set_value(w, c, normal[static_cast<std::size_t>(c)]);
    if (!mesh.has_seams() && wall_normals.empty()) d.mesh.wedge_vertex = {};
    r.limited = ways.limited;
    r.still = ways.still;
    if (mesh.face_count() > 0) measure(d.mesh, mesh, s.to_world, r);
    r.unbalanced = unbalanced_edges(d.mesh);
    if (s.self_intersections && s.thickness <= size_of(mesh, s.to_world))
        r.self_intersections = find_self_intersections(d.mesh, {.limit = 0}).count;
    r.mesh = std::move(d.mesh);
    return r;
}

} // namespace

ThickenResult thicken(const Mesh& mesh, const ThickenSettings& s) {
    const LinkCounts links = count_links(mesh);
    if (links.crowded_edges == 0 && links.non_manifold_vertices == 0) return thicken_sheets(mesh, s);
    clean_steps::Work apart{.mesh = mesh, .counts = {}, .not_done = {}, .changes = {}};
    clean_steps::split_non_manifold(apart);
    return thicken_sheets(apart.mesh, s);
}

} // namespace facetmill
