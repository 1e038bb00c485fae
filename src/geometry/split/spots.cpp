#include "geometry/split/spots.hpp"

#include "geometry/split/centre.hpp"
#include "mesh/face.hpp"
#include "mesh/quad_diagonal.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <span>

namespace facetmill {

namespace {

/// A corner at an end of an edge, and the far vertex of the corner's other edge.
struct Turn {
    Index beyond, corner;
    bool operator<(const Turn& b) const { return beyond != b.beyond ? beyond < b.beyond : corner < b.corner; }
};

/// Calls visit(corners of faces that share the edge and the next edge at its end) for each end of edge e.
template <class Visit>
void visit_shared(const Mesh& mesh, const EdgeTable& edges, const std::vector<Index>& faces, Index e,
                  std::vector<Turn>& room, Visit&& visit) {
    const auto around = edges.corners_of(e);
    if (around.size() < 2) return;
    const auto face = [&](Index c) { return faces.empty() ? c / 3 : faces[c]; };
    for (const Index end : {edges.edges[e].low, edges.edges[e].high}) {
        room.clear();
        for (const Index c : around) {
            const Index f = face(c);
            if (mesh.vertex(c) == end) {
                room.push_back({mesh.vertex(previous_corner(mesh, f, c)), c});
            } else {
                const Index next = next_corner(mesh, f, c);
                room.push_back({mesh.vertex(next_corner(mesh, f, next)), next});
            }
        }
        if (room.size() == 2 && room[0].beyond != room[1].beyond) continue;
        std::sort(room.begin(), room.end());
        for (std::size_t i = 0, j = 0; i < room.size(); i = j) {
            while (j < room.size() && room[j].beyond == room[i].beyond) ++j;
            if (j - i > 1 && room[i].beyond != end) visit(std::span<const Turn>(&room[i], j - i), end);
        }
    }
}

Index other_end(const EdgeTable::Edge& edge, Index end) { return edge.low == end ? edge.high : edge.low; }

/// Whether triangles may share two edges. If all edges have two faces, a third of the edges decides: such
/// triangles share all three edges, including the first edge of the lower triangle.
bool may_share(const Mesh& mesh, const EdgeTable& edges) {
    const auto apex = [&](Index c) { return mesh.vertex(c - c % 3 + (c % 3 + 2) % 3); };
    return parallel_reduce(
               edges.size(), std::size_t{0},
               [&](std::size_t begin, std::size_t end) {
                   std::size_t found = 0;
                   for (auto e = static_cast<Index>(begin); e < end; ++e) {
                       const auto at = edges.corners_of(e);
                       found +=
                           at.size() > 2 || (at.size() == 2 && at[0] % 3 == 0 && apex(at[0]) == apex(at[1]));
                   }
                   return found;
               },
               [](std::size_t a, std::size_t b) { return a + b; }) > 0;
}

std::vector<Index> faces_of_corners(const Mesh& mesh) {
    return mesh.all_triangles() ? std::vector<Index>{} : corner_faces(mesh);
}

/// Whether the triangle of three points faces against the normal.
bool looks_back(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    return dot(cross(b - a, c - a), normal) < 0;
}

bool has_reflex_corner(const Mesh& mesh, Index f, const Vec3& normal) {
    const Index begin = mesh.face_begin(f), n = mesh.face_size(f);
    for (Index k = 0; k < n; ++k)
        if (looks_back(mesh.point(begin + k), mesh.point(begin + (k + 1) % n),
                       mesh.point(begin + (k + 2) % n), normal))
            return true;
    return false;
}

} // namespace

std::vector<std::uint8_t> shared_corners(const Mesh& mesh, const EdgeTable& edges) {
    std::vector<std::uint8_t> shared(mesh.corner_count());
    const std::vector<Index> faces = faces_of_corners(mesh);
    parallel_chunks(edges.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Turn> room;
        for (auto e = static_cast<Index>(begin); e < end; ++e)
            visit_shared(mesh, edges, faces, e, room, [&](std::span<const Turn> turns, Index at) {
                if (turns[0].beyond < other_end(edges.edges[e], at))
                    return; // this spot is visited from its other edge
                for (const Turn& t : turns) shared[t.corner] = 1;
            });
    });
    return shared;
}

std::size_t shared_cuts(const Mesh& mesh, const EdgeTable& edges, const std::vector<std::uint8_t>& marks,
                        const std::vector<std::uint8_t>& counted) {
    if (mesh.all_triangles() && !may_share(mesh, edges)) return 0;
    const std::vector<Index> faces = faces_of_corners(mesh);
    const auto is_triangle = [&](const Turn& t) {
        return faces.empty() || mesh.face_size(faces[t.corner]) == 3;
    };
    const auto is_cut = [&](const Turn& t) {
        if (marks.empty()) return true;
        const Index f = faces.empty() ? t.corner / 3 : faces[t.corner];
        return marks[edges.corner_edge[t.corner]] ||
               marks[edges.corner_edge[previous_corner(mesh, f, t.corner)]];
    };
    return parallel_reduce(
        edges.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t found = 0;
            std::vector<Turn> room;
            for (auto e = static_cast<Index>(begin); e < end; ++e)
                visit_shared(mesh, edges, faces, e, room, [&](std::span<const Turn> turns, Index at) {
                    if (turns[0].beyond < other_end(edges.edges[e], at)) return;
                    if (!counted.empty() && !counted[at]) return;
                    found += is_cut(turns[0]) && std::count_if(turns.begin(), turns.end(), is_triangle) > 1;
                });
            return found;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
}

std::size_t shared_spots(const Mesh& mesh, const std::vector<std::uint8_t>& counted) {
    return shared_cuts(mesh, build_edges(mesh), {}, counted);
}

std::size_t folding_faces(const Mesh& mesh, SplitMethod method) {
    using enum SplitMethod;
    const bool between = method == grid || method == halve || method == varignon;
    const bool to_centre =
        method == midpoint || method == quads || method == centroid || method == fan || method == core;
    if (mesh.all_triangles() || (!between && !to_centre)) return 0;
    return parallel_reduce(
        mesh.face_count(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t found = 0;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                if (mesh.face_size(f) == 3) continue;
                const Vec3 normal = area_vector(mesh, f);
                found += between ? has_reflex_corner(mesh, f, normal)
                                 : hides_from_centre(mesh, f, centre_weights(mesh, f));
            }
            return found;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
}

} // namespace facetmill
