#include "geometry/crop/folds.hpp"

#include "geometry/crop/trace.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace facetmill {

namespace {

using Triangle = std::array<Index, 3>;

/// From the lowest vertex on.
Triangle turned(const Mesh& mesh, Index face) {
    const Index c = mesh.face_begin(face);
    Triangle t{mesh.vertex(c), mesh.vertex(c + 1), mesh.vertex(c + 2)};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

/// Pairs of a triangle of a wall and a kept one, the same the other way round.
std::vector<std::pair<Index, Index>> find_pairs(const Mesh& mesh, std::size_t first_wall) {
    std::vector<std::uint8_t> at_wall(mesh.vertex_count());
    std::vector<std::pair<Triangle, Index>> walls; // as the kept ones would be
    for (auto f = static_cast<Index>(first_wall); f < mesh.face_count(); ++f) {
        if (mesh.face_size(f) != 3) continue;
        const auto [a, b, c] = turned(mesh, f);
        walls.push_back({{a, c, b}, f});
        at_wall[a] = at_wall[b] = at_wall[c] = 1;
    }
    std::sort(walls.begin(), walls.end());
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<std::uint8_t> taken(walls.size());
    for (Index f = 0; f < first_wall; ++f) {
        if (mesh.face_size(f) != 3) continue;
        const Triangle t = turned(mesh, f);
        if (!at_wall[t[0]] || !at_wall[t[1]] || !at_wall[t[2]]) continue;
        auto found = std::lower_bound(walls.begin(), walls.end(), std::pair{t, Index{0}});
        while (found != walls.end() && found->first == t && taken[found - walls.begin()]) ++found;
        if (found == walls.end() || found->first != t) continue;
        taken[found - walls.begin()] = 1;
        pairs.emplace_back(f, found->second);
    }
    return pairs;
}

using Edge = std::pair<Index, Index>;

template <class Visit>
void for_edges(const Mesh& mesh, Index face, Visit&& visit) {
    const Index begin = mesh.face_begin(face), end = mesh.face_end(face);
    for (Index c = begin; c < end; ++c)
        visit(Edge(std::minmax(mesh.vertex(c), mesh.vertex(c + 1 < end ? c + 1 : begin))));
}

} // namespace

std::size_t remove_folds(Mesh& mesh, std::size_t first_wall) {
    const auto pairs = find_pairs(mesh, first_wall);
    if (pairs.empty()) return 0;
    std::map<Edge, std::size_t> uses;
    for (const auto& [kept, wall] : pairs) for_edges(mesh, kept, [&](const Edge& e) { uses[e] = 0; });
    std::vector<std::uint8_t> near(mesh.vertex_count());
    for (const auto& [edge, count] : uses) near[edge.first] = near[edge.second] = 1;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for_edges(mesh, f, [&](const Edge& e) {
            if (!near[e.first] || !near[e.second]) return;
            if (const auto found = uses.find(e); found != uses.end()) ++found->second;
        });
    std::vector<std::uint8_t> goes(mesh.face_count());
    std::size_t walls = 0;
    for (const auto& [kept, wall] : pairs) {
        bool crowded = false;
        for_edges(mesh, kept, [&](const Edge& e) { crowded |= uses.at(e) > 2; });
        if (!crowded) continue;
        goes[kept] = goes[wall] = 1;
        for_edges(mesh, kept, [&](const Edge& e) { uses.at(e) -= 2; });
        ++walls;
    }
    if (walls == 0) return 0;
    std::vector<Index> stay;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (!goes[f]) stay.push_back(f);
    mesh = select_faces(mesh, stay);
    return walls;
}

} // namespace facetmill
