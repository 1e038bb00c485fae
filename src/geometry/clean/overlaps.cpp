// Solids that overlap and yet meet in edges only: grids that cross along their lines.
#include "geometry/edit/around_edge.hpp"
#include "geometry/clean/steps.hpp"

#include <algorithm>

namespace facetmill::clean_steps {

namespace {

/// Whether two leaves, neighbours in the order around the edge, are at the same angle.
bool same_angle(const Vec3& u, const Vec3& v, const EdgeLeaf& a, const EdgeLeaf& b) {
    return a.half == b.half && (a.half % 2 == 0 || orientation_3d(u, v, a.beside, b.beside) == 0);
}

/// Whether the winding number takes more than two values around the edge.
bool winds_twice(const Vec3& u, const Vec3& v, std::vector<EdgeLeaf> leaves) {
    sort_around_edge(u, v, leaves);
    int winding = 0, least = 0, most = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        winding += leaves[i].forward ? -1 : 1; // the inside is before a forward face
        if (i + 1 < leaves.size() && same_angle(u, v, leaves[i], leaves[i + 1])) continue;
        least = std::min(least, winding);
        most = std::max(most, winding);
    }
    return winding == 0 && most - least > 1;
}

} // namespace

std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh) {
    Mesh plain; // vertices at one place are one
    plain.positions = mesh.positions;
    plain.face_offsets = mesh.face_offsets;
    const auto place = lowest_at_place(mesh);
    for (Index c = 0; c < mesh.corner_count(); ++c) plain.corners.push_back(place[mesh.vertex(c)]);
    const auto edges = build_edges(plain);
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<Index> faces;
    for (Index e = 0; e < edges.size(); ++e) {
        const auto corners = edges.corners_of(e);
        if (corners.size() < 4) continue;
        if (faces.empty()) faces = corner_faces(plain);
        const auto& [low, high] = edges.edges[e];
        std::vector<EdgeLeaf> leaves;
        for (const Index c : corners)
            leaves.push_back({c, beside_edge(plain, faces[c], c), plain.vertex(c) == low});
        if (!winds_twice(plain.positions[low], plain.positions[high], std::move(leaves))) continue;
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) // a chain: all pairs could be too many
            if (faces[corners[i]] != faces[corners[i + 1]])
                pairs.push_back(std::minmax({faces[corners[i]], faces[corners[i + 1]]}));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

} // namespace facetmill::clean_steps
