// The step of clean that removes pieces hidden inside others.
#include "geometry/clean/steps.hpp"
#include "geometry/spatial/rays.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/edit/surgery.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace facetmill::clean_steps {

namespace {

/// Whether each piece is closed by itself: the directions of its faces cancel at every edge.
std::vector<std::uint8_t> closed_pieces(const Mesh& mesh, const Components& pieces) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<std::uint8_t> closed(pieces.count, 1);
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
        if (balance != 0) closed[pieces.of_face[faces[edges.corners_of(e)[0]]]] = 0;
    }
    return closed;
}

} // namespace

bool remove_inner_components(Work& work) {
    const Mesh& mesh = work.mesh;
    const Components pieces = face_components(mesh, false); // all faces of an edge are of one piece
    if (pieces.count < 2) return false;
    const auto closed = closed_pieces(mesh, pieces);
    std::set<std::pair<Index, Index>> touching;
    constexpr std::size_t most_pairs = std::size_t{1} << 24;
    for (const auto& [f, g] : find_self_intersections(mesh, {.limit = most_pairs}).pairs) {
        const Index a = pieces.of_face[f], b = pieces.of_face[g];
        touching.emplace(std::min(a, b), std::max(a, b));
    }
    std::vector<Index> first(pieces.count, none);
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (first[pieces.of_face[f]] == none) first[pieces.of_face[f]] = f;
    const FaceTree rays(surface_of(mesh), FaceTree::Use::rays);
    std::vector<std::uint8_t> inside(pieces.count, 0);
    for (Index p = 0; p < pieces.count; ++p) {
        if (!closed[p]) continue;
        std::map<Index, int> turns;
        visit_along_axis(rays, mesh.point(mesh.face_begin(first[p])), 0, true, [&](Index f, int way) {
            if (closed[pieces.of_face[f]]) turns[pieces.of_face[f]] += way;
        });
        for (const auto& [q, n] : turns)
            if (q != p && n != 0 && !touching.contains({std::min(p, q), std::max(p, q)})) inside[p] = 1;
    }
    const auto count = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1));
    if (count == 0) return false;
    std::vector<std::uint8_t> gone(mesh.face_count());
    for (Index f = 0; f < gone.size(); ++f) gone[f] = inside[pieces.of_face[f]];
    const auto kept = faces_without(gone);
    work.counts.inner_components += count;
    work.counts.inner_component_faces += gone.size() - kept.size();
    work.mesh = keep_faces(mesh, kept);
    return true;
}

} // namespace facetmill::clean_steps
