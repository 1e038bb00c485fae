#include "geometry/edit/split_non_manifold.hpp"

#include "base/math/numbers.hpp"
#include "geometry/edit/around_edge.hpp"
#include "geometry/edit/surgery.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

/// Pairs of corners that stay together along a crowded edge, because the inside is between their faces.
/// Around the edge, a forward face follows the inside, and a backward face precedes it.
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

/// Faces whose sheet has a boundary. A sheet is connected over edges of two faces.
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
    /// A fin on a solid is between two of its faces, or outside them; the faces stay together without it.
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
    std::vector<std::uint8_t> open_; ///< [faces] only if the mesh has crowded edges
};

/// The corners of a crowded edge that share a new point, as pairs. A single remaining face is paired with
/// itself.
std::vector<std::pair<Index, Index>> groups_at(const EdgeTable& edges, const Joints& joints, Index e) {
    const auto corners = edges.corners_of(e);
    auto groups = joints.at(e);
    std::vector<std::uint8_t> paired(corners.size(), 0);
    for (const auto& [a, b] : groups)
        for (std::size_t i = 0; i < corners.size(); ++i) paired[i] |= corners[i] == a || corners[i] == b;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (!paired[i]) groups.emplace_back(corners[i], corners[i]);
    return groups;
}

/// The source of each face of a mesh after vertices were inserted on its edges.
std::vector<Index> parents_of(const Mesh& mesh, const std::vector<Index>& faces,
                              const std::vector<Insertion>& insertions) {
    std::vector<Index> pieces(mesh.face_count(), 1);
    for (const Insertion& i : insertions)
        if (const Index f = faces[i.corner]; mesh.face_size(f) == 3) ++pieces[f];
    std::vector<Index> parents;
    for (Index f = 0; f < pieces.size(); ++f) parents.insert(parents.end(), pieces[f], f);
    return parents;
}

} // namespace

Fans disjoint_fans(const Mesh& mesh) { return disjoint_fans(mesh, build_edges(mesh)); }

Fans disjoint_fans(const Mesh& mesh, const EdgeTable& edges) {
    const auto faces = corner_faces(mesh);
    const Joints joints(mesh, edges, faces);
    // Corners at a vertex belong to the same fan if a joint at this vertex links them.
    DisjointSets fans(mesh.corner_count());
    const auto link = [&](Index a, Index b) {
        const Index a_end = next_corner(mesh, faces[a], a), b_end = next_corner(mesh, faces[b], b);
        const bool same = mesh.vertex(a) == mesh.vertex(b);
        fans.join(a, same ? b : b_end);
        fans.join(a_end, same ? b_end : b);
    };
    parallel_for(edges.size(), [&](std::size_t i) {
        const auto e = static_cast<Index>(i);
        if (const auto corners = edges.corners_of(e); corners.size() == 2)
            link(corners[0], corners[1]); // the same as joints.at, without its memory
        else
            for (const auto& [a, b] : joints.at(e)) link(a, b);
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

EdgeTable part_fans(Mesh& mesh, std::size_t& parted) {
    EdgeTable edges = build_edges(mesh);
    const Fans fans = disjoint_fans(mesh, edges);
    parted = fans.copies.size();
    if (parted == 0) return edges;
    mesh = part_corners(mesh, fans.vertex_of_corner, fans.copies);
    return build_edges(mesh);
}

DividedEdges divide_crowded_edges(const Mesh& mesh, const EdgeTable& edges, const EdgeDivision& how) {
    DividedEdges result;
    if (!has_crowded_edges(edges)) return result;
    const auto faces = corner_faces(mesh);
    const Joints joints(mesh, edges, faces);
    std::vector<Insertion> insertions;
    std::vector<Provenance::Edge> added;
    std::vector<Vec3> points;
    for (Index e = 0; e < edges.size(); ++e) {
        const auto& [low, high] = edges.edges[e];
        if (edges.corners_of(e).size() <= 2 || how.leave.contains({low, high})) continue;
        const Vec3 &a = mesh.positions[low], &b = mesh.positions[high];
        const Vec3 middle = mix(a, b, 0.5), rounded = as_float32(middle);
        const Vec3 point = how.single && is_finite(rounded) ? rounded : middle;
        const bool beside = is_finite(a) && is_finite(b) && is_finite(point) &&
                            (point == a || point == b || !collinear(a, b, point));
        result.edges.push_back({low, high, point, beside});
        const auto groups = groups_at(edges, joints, e);
        for (std::size_t g = how.all || beside ? 0 : 1; g < groups.size(); ++g) {
            const auto v = static_cast<Index>(mesh.vertex_count() + added.size());
            added.push_back({low, high, 0.5});
            points.push_back(point);
            result.edge_of_point.push_back(static_cast<Index>(result.edges.size() - 1));
            insertions.push_back({groups[g].first, 0.5, v});
            if (groups[g].second != groups[g].first) insertions.push_back({groups[g].second, 0.5, v});
        }
    }
    if (result.edges.empty()) return result;
    result.parents = parents_of(mesh, faces, insertions);
    result.mesh = insert_on_edges(mesh, std::move(insertions), added, &result.changes);
    std::copy(points.begin(), points.end(),
              result.mesh.positions.begin() + static_cast<std::ptrdiff_t>(mesh.vertex_count()));
    return result;
}

Mesh split_non_manifold(Mesh mesh) {
    std::size_t parted = 0;
    const EdgeTable edges = part_fans(mesh, parted);
    DividedEdges divided = divide_crowded_edges(mesh, edges, {});
    return divided.edges.empty() ? std::move(mesh) : std::move(divided.mesh);
}

} // namespace facetmill
