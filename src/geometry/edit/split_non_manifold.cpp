#include "geometry/edit/split_non_manifold.hpp"

#include "base/parallel.hpp"
#include "geometry/edit/around_edge.hpp"
#include "geometry/edit/surgery.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

/// Pairs of corners that stay together along a crowded edge: those that have the inside between them. A
/// forward face has the inside before it around the edge, a backward one behind it.
std::vector<std::pair<Index, Index>> pairs_along(std::vector<EdgeLeaf> leaves) {
    std::vector<std::pair<Index, Index>> pairs;
    for (bool found = true; found && leaves.size() > 1;) {
        found = false;
        for (std::size_t i = 0; i < leaves.size() && !found; ++i) {
            const std::size_t next = (i + 1) % leaves.size();
            if (leaves[i].forward || !leaves[next].forward) continue;
            pairs.emplace_back(leaves[i].corner, leaves[next].corner);
            const std::size_t low = std::min(i, next), high = std::max(i, next);
            leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(high));
            leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(low));
            found = true;
        }
    }
    return pairs;
}

bool has_crowded_edges(const EdgeTable& edges) {
    for (Index e = 0; e < edges.size(); ++e)
        if (edges.corners_of(e).size() > 2) return true;
    return false;
}

/// Faces whose sheet has a boundary: what hangs together over edges of two faces.
std::vector<std::uint8_t> faces_of_open_sheets(const Mesh& mesh, const EdgeTable& edges,
                                               const std::vector<Index>& faces) {
    DisjointSets sheets(mesh.face_count());
    for (Index e = 0; e < edges.size(); ++e) {
        const auto corners = edges.corners_of(e);
        if (corners.size() == 2) sheets.join(faces[corners[0]], faces[corners[1]]);
    }
    std::vector<std::uint8_t> open(mesh.face_count(), 0);
    for (Index e = 0; e < edges.size(); ++e)
        if (const auto corners = edges.corners_of(e); corners.size() == 1)
            open[sheets.find(faces[corners[0]])] = 1;
    for (Index f = 0; f < open.size(); ++f) open[f] = open[sheets.find(f)];
    return open;
}

/// The faces that are joined along each edge, as pairs of corners.
class Joints {
  public:
    Joints(const Mesh& mesh, const EdgeTable& edges, const std::vector<Index>& faces)
        : mesh_(mesh), edges_(edges), faces_(faces) {
        if (has_crowded_edges(edges)) open_ = faces_of_open_sheets(mesh, edges, faces);
    }

    std::vector<std::pair<Index, Index>> at(Index e) const {
        const auto corners = edges_.corners_of(e);
        if (corners.size() < 2) return {};
        if (corners.size() == 2) return {{corners[0], corners[1]}};
        std::vector<EdgeLeaf> leaves;
        const auto& [low, high] = edges_.edges[e];
        for (const Index c : corners)
            leaves.push_back({c, beside_edge(mesh_, faces_[c], c), mesh_.vertex(c) == low});
        sort_around_edge(mesh_.positions[low], mesh_.positions[high], leaves);
        return joined(leaves);
    }

  private:
    /// A fin on a solid lies between two of its faces, or beside them; they stay together without it.
    std::vector<std::pair<Index, Index>> joined(const std::vector<EdgeLeaf>& leaves) const {
        std::vector<EdgeLeaf> closed, open;
        for (const EdgeLeaf& leaf : leaves) (open_[faces_[leaf.corner]] ? open : closed).push_back(leaf);
        const auto forward =
            std::count_if(closed.begin(), closed.end(), [](const EdgeLeaf& leaf) { return leaf.forward; });
        if (2 * static_cast<std::size_t>(forward) != closed.size()) return pairs_along(leaves);
        auto pairs = pairs_along(std::move(closed));
        const auto fins = pairs_along(std::move(open));
        pairs.insert(pairs.end(), fins.begin(), fins.end());
        return pairs;
    }

    const Mesh& mesh_;
    const EdgeTable& edges_;
    const std::vector<Index>& faces_;
    std::vector<std::uint8_t> open_; ///< [faces] where there are crowded edges
};

/// Puts a point in the middle of crowded edges that no vertex could take apart, for every pair (but the first
/// unless `all`) and every face left over.
void divide_crowded_edges(NonManifoldSplit& work, const EdgeTable& edges, bool all) {
    const Mesh& mesh = work.mesh;
    if (!has_crowded_edges(edges)) return;
    const auto faces = corner_faces(mesh);
    const Joints joints(mesh, edges, faces);
    std::vector<Insertion> insertions;
    std::vector<Lineage::Edge> added;
    for (Index e = 0; e < edges.size(); ++e) {
        const auto corners = edges.corners_of(e);
        if (corners.size() <= 2) continue;
        auto groups = joints.at(e);
        std::vector<std::uint8_t> paired(corners.size(), 0);
        for (const auto& [a, b] : groups)
            for (std::size_t i = 0; i < corners.size(); ++i) paired[i] |= corners[i] == a || corners[i] == b;
        for (std::size_t i = 0; i < corners.size(); ++i)
            if (!paired[i]) groups.emplace_back(corners[i], corners[i]);
        for (std::size_t g = all ? 0 : 1; g < groups.size(); ++g) {
            const auto v = static_cast<Index>(mesh.vertex_count() + added.size());
            added.push_back({edges.edges[e].low, edges.edges[e].high, 0.5});
            insertions.push_back({groups[g].first, 0.5, v});
            if (groups[g].second != groups[g].first) insertions.push_back({groups[g].second, 0.5, v});
        }
        ++work.split_edges;
    }
    work.mesh = insert_on_edges(mesh, std::move(insertions), added, &work.changes);
}

} // namespace

Fans disjoint_fans(const Mesh& mesh) { return disjoint_fans(mesh, build_edges(mesh)); }

Fans disjoint_fans(const Mesh& mesh, const EdgeTable& edges) {
    const auto faces = corner_faces(mesh);
    const Joints joints(mesh, edges, faces);
    // Corners at a vertex are of one fan when a joint at that vertex links them.
    DisjointSets fans(mesh.corner_count());
    parallel_for(edges.size(), [&](std::size_t e) {
        for (const auto& [a, b] : joints.at(static_cast<Index>(e))) {
            const Index a_end = next_corner(mesh, faces[a], a), b_end = next_corner(mesh, faces[b], b);
            const bool same = mesh.vertex(a) == mesh.vertex(b);
            fans.join(a, same ? b : b_end);
            fans.join(a_end, same ? b_end : b);
        }
    });
    Fans result;
    result.vertex_of_corner.resize(mesh.corner_count());
    std::vector<Index> first_fan(mesh.vertex_count(), none), vertex_of_fan(mesh.corner_count(), none);
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Index v = mesh.vertex(c), fan = fans.find(c);
        if (vertex_of_fan[fan] == none) {
            if (first_fan[v] == none) {
                first_fan[v] = fan;
                vertex_of_fan[fan] = v;
            } else {
                vertex_of_fan[fan] = static_cast<Index>(mesh.vertex_count() + result.copies.size());
                result.copies.push_back(v);
            }
        }
        result.vertex_of_corner[c] = vertex_of_fan[fan];
    }
    return result;
}

NonManifoldSplit split_non_manifold(Mesh mesh, bool divide_all) {
    NonManifoldSplit result{std::move(mesh), {}, 0, 0};
    EdgeTable edges = build_edges(result.mesh);
    const Fans fans = disjoint_fans(result.mesh, edges);
    if (!fans.copies.empty()) {
        result.split_vertices = fans.copies.size();
        result.mesh = part_corners(result.mesh, fans.vertex_of_corner, fans.copies);
        edges = build_edges(result.mesh);
    }
    divide_crowded_edges(result, edges, divide_all);
    return result;
}

} // namespace facetmill
