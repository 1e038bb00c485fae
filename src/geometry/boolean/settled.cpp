#include "geometry/boolean/settled.hpp"

#include "geometry/clean/steps.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/indices_where.hpp"

namespace facetmill::clean_steps {

bool is_tidy(const Mesh& mesh, const std::vector<std::uint8_t>& settled, std::size_t uncut) {
    if (settled.empty() || !mesh.all_triangles() || !are_distinct(lowest_at_place(mesh))) return false;
    for (auto f = static_cast<Index>(uncut); f < mesh.face_count(); ++f)
        if (is_degenerate(mesh, f)) return false;
    const auto is_settled = [&](Index f) {
        const Index c = mesh.face_begin(f);
        return settled[mesh.vertex(c)] && settled[mesh.vertex(c + 1)] && settled[mesh.vertex(c + 2)];
    };
    const auto faces = indices_where(mesh.face_count(), [&](Index f) { return !is_settled(f); });
    const Mesh some = only_faces(mesh, faces);
    std::vector<std::uint8_t> whole(some.vertex_count()); // `some` contains all of its faces
    for (Index c = 0; c < some.corner_count(); ++c)
        whole[some.vertex(c)] = !settled[mesh.vertex(mesh.face_begin(faces[c / 3]) + c % 3)];
    const EdgeTable edges = build_edges(some);
    for (Index e = 0; e < edges.size(); ++e) {
        const auto& [low, high] = edges.edges[e];
        const auto at = edges.corners_of(e);
        if (!whole[low] && !whole[high]) continue;
        if (at.size() != 2 || some.vertex(at[0]) == some.vertex(at[1])) return false;
    }
    if (!duplicate_faces(some).empty()) return false;
    const Fans fans = disjoint_fans(some, edges);
    return std::none_of(fans.copies.begin(), fans.copies.end(), [&](Index v) { return whole[v] != 0; });
}

} // namespace facetmill::clean_steps
