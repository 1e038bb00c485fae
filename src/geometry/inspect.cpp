#include "geometry/inspect.hpp"

#include "base/parallel.hpp"
#include "geometry/evidence.hpp"
#include "mesh/topology.hpp"

#include <numeric>

namespace facetmill {

namespace {

struct EdgeCounts {
    std::int64_t boundary = 0;
    bool closed = true, manifold = true, oriented = true;
};

EdgeCounts count_edges(const Mesh& mesh, const EdgeTable& edges) {
    return parallel_reduce(
        edges.size(), EdgeCounts{},
        [&](std::size_t begin, std::size_t end) {
            EdgeCounts counts;
            for (std::size_t e = begin; e < end; ++e) {
                const auto corners = edges.corners_of(static_cast<Index>(e));
                std::int64_t balance = 0;
                for (const Index c : corners) balance += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
                counts.boundary += corners.size() == 1;
                counts.closed &= balance == 0;
                counts.manifold &= corners.size() <= 2;
                counts.oriented &= balance >= -1 && balance <= 1;
            }
            return counts;
        },
        [](EdgeCounts a, const EdgeCounts& b) {
            a.boundary += b.boundary;
            a.closed &= b.closed, a.manifold &= b.manifold, a.oriented &= b.oriented;
            return a;
        });
}

/// How many closed chains the boundary edges form. Where two fans meet at a vertex the chains pass each
/// other: each goes on along its own fan.
std::int64_t count_boundary_loops(const Mesh& mesh, const EdgeTable& edges) {
    const auto faces = corner_faces(mesh);
    std::vector<Index> boundary;
    std::vector<Index> place(edges.size(), none);
    for (Index e = 0; e < edges.size(); ++e)
        if (edges.corners_of(e).size() == 1)
            place[e] = static_cast<Index>(boundary.size()), boundary.push_back(e);
    std::vector<Index> parent(boundary.size());
    std::iota(parent.begin(), parent.end(), Index{0});
    const auto root = [&](Index i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::int64_t loops = static_cast<std::int64_t>(boundary.size());
    for (const Index e : boundary) {
        // Turn around the vertex at the end of the edge's only corner, from face to face, to the fan's other
        // side.
        Index c = edges.corners_of(e).front();
        for (std::size_t turns = 0; turns <= mesh.corner_count(); ++turns) {
            const Index next = next_corner(mesh, faces[c], c);
            const Index along = edges.corner_edge[next];
            if (along == none) break;
            const auto corners = edges.corners_of(along);
            if (corners.size() == 1) {
                const Index a = root(place[e]), b = root(place[along]);
                if (a != b) parent[std::max(a, b)] = std::min(a, b), --loops;
                break;
            }
            const Index other = corners[0] == next ? corners[1] : corners[0];
            if (mesh.vertex(other) == mesh.vertex(next)) break; // the neighbour is flipped: no fan to follow
            c = other;
        }
    }
    return loops;
}

struct Sums {
    double area = 0, volume = 0;
    std::int64_t degenerate = 0, triangles = 0;
};

/// Area of polygons as half the length of their vector area; volume by the divergence theorem about the
/// centre.
Sums sum_faces(const Mesh& mesh, const Vec3& centre) {
    return parallel_reduce(
        mesh.face_count(), Sums{},
        [&](std::size_t begin, std::size_t end) {
            Sums sums;
            for (std::size_t i = begin; i < end; ++i) {
                const Index f = static_cast<Index>(i), first = mesh.face_begin(f), last = mesh.face_end(f);
                const Vec3 a = mesh.point(first) - centre;
                Vec3 vector_area;
                for (Index c = first + 1; c + 1 < last; ++c) {
                    const Vec3 b = mesh.point(c) - centre, d = mesh.point(c + 1) - centre;
                    vector_area += cross(b - a, d - a);
                    sums.volume += dot(a, cross(b, d)) / 6;
                }
                sums.area += length(vector_area) / 2;
                sums.triangles += last - first == 3;
                sums.degenerate += is_degenerate(mesh, f);
            }
            return sums;
        },
        [](Sums a, const Sums& b) {
            a.area += b.area, a.volume += b.volume;
            a.degenerate += b.degenerate, a.triangles += b.triangles;
            return a;
        });
}

/// The part's mesh as it stands in the world.
Mesh in_world(const Part& part) {
    Mesh mesh;
    mesh.wedge_vertex = part.mesh.wedge_vertex;
    mesh.corners = part.mesh.corners;
    mesh.face_offsets = part.mesh.face_offsets;
    mesh.positions = part.mesh.positions;
    apply(mesh, part.transform);
    return mesh;
}

void add(Properties& all, const Properties& one) {
    for (auto member :
         {&Properties::vertices, &Properties::wedges, &Properties::edges, &Properties::faces,
          &Properties::triangles, &Properties::components, &Properties::euler, &Properties::boundary_loops,
          &Properties::boundary_edges, &Properties::degenerate_faces, &Properties::duplicate_faces,
          &Properties::isolated_vertices})
        all.*member += one.*member;
    for (auto member : {&Properties::closed, &Properties::edge_manifold, &Properties::vertex_manifold,
                        &Properties::oriented})
        all.*member = all.*member && one.*member;
    for (auto member : {&Properties::genus, &Properties::self_intersections})
        all.*member =
            all.*member && one.*member ? std::optional(*(all.*member) + *(one.*member)) : std::nullopt;
    all.volume = all.volume && one.volume ? std::optional(*all.volume + *one.volume) : std::nullopt;
    all.area += one.area;
    all.bounds.add(one.bounds);
}

} // namespace

Properties inspect(const Mesh& mesh, const InspectSettings&) {
    Properties p;
    const EdgeTable edges = build_edges(mesh);
    p.vertices = static_cast<std::int64_t>(mesh.vertex_count());
    p.wedges = static_cast<std::int64_t>(mesh.wedge_count());
    p.edges = static_cast<std::int64_t>(edges.size());
    p.faces = static_cast<std::int64_t>(mesh.face_count());
    p.components = static_cast<std::int64_t>(face_components(mesh).count);

    const EdgeCounts counts = count_edges(mesh, edges);
    p.boundary_edges = counts.boundary;
    p.closed = counts.closed, p.edge_manifold = counts.manifold, p.oriented = counts.oriented;
    p.boundary_loops = counts.boundary ? count_boundary_loops(mesh, edges) : 0;

    for (const Index fans : fans_at_vertices(mesh, edges)) {
        p.isolated_vertices += fans == 0;
        p.vertex_manifold &= fans <= 1;
    }
    p.euler = p.vertices - p.isolated_vertices - p.edges + p.faces;
    if (p.closed && p.edge_manifold && p.vertex_manifold && p.oriented) p.genus = p.components - p.euler / 2;

    p.bounds = mesh.bounds();
    const Sums sums = sum_faces(mesh, p.bounds.empty() ? Vec3{} : p.bounds.centre());
    p.area = sums.area;
    p.triangles = sums.triangles;
    p.degenerate_faces = sums.degenerate;
    p.duplicate_faces = static_cast<std::int64_t>(duplicate_faces(mesh, edges).size());
    if (p.closed) p.volume = sums.volume;
    return p;
}

Properties inspect(const Scene& scene, const InspectSettings& settings) {
    Properties all;
    all.genus = 0, all.volume = 0;
    if (settings.self_intersections) all.self_intersections = 0;
    for (const auto& part : scene.parts)
        add(all,
            part.transform.identity() ? inspect(part.mesh, settings) : inspect(in_world(part), settings));
    return all;
}

} // namespace facetmill
