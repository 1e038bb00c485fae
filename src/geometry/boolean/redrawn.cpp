#include "geometry/boolean/redrawn.hpp"

#include "base/math/predicates.hpp"
#include "geometry/edit/redrawn_faces.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace facetmill::clean_steps {

namespace {

using Triple = std::array<Index, 3>;

/// Decides whether triangles that share an edge form a flat face.
class Flatness {
  public:
    Flatness(const Mesh& mesh, const TriangleFaces& triangles) : mesh_(mesh), triangles_(triangles) {}

    /// The edge starts at corner i of s and at corner j of t, which traverse it in opposite directions.
    bool is_flat(Index s, std::size_t i, Index t, std::size_t j) const {
        const auto corner = [&](Index of, std::size_t k) { return triangles_.corners[of][k % 3]; };
        const Triple abc{corner(s, i), corner(s, i + 1), corner(s, i + 2)};
        const Index d = corner(t, j + 2);
        if (!is_planar(abc, d)) return false;
        return std::all_of(mesh_.attributes.begin(), mesh_.attributes.end(), [&](const Attribute& a) {
            if (a.domain == Domain::face) return is_same_value(a, triangles_.face[s], triangles_.face[t]);
            const bool of_wedges = a.domain == Domain::wedge;
            if (of_wedges && (mesh_.corners[abc[0]] != mesh_.corners[corner(t, j + 1)] ||
                              mesh_.corners[abc[1]] != mesh_.corners[corner(t, j)]))
                return false;
            const auto at = [&](Index c) { return of_wedges ? mesh_.corners[c] : mesh_.vertex(c); };
            return is_linear(a, {at(abc[0]), at(abc[1]), at(abc[2]), at(d)}, weights(abc, d));
        });
    }

  private:
    /// True if d is in the plane of abc, on the other side of the edge from the first to the second.
    bool is_planar(const Triple& abc, Index d) const {
        const Vec3 &a = mesh_.point(abc[0]), &b = mesh_.point(abc[1]), &c = mesh_.point(abc[2]),
                   &p = mesh_.point(d);
        if (orientation_3d(a, b, c, p) != 0) return false;
        for (std::size_t u = 0; u < 3; ++u) {
            const std::size_t v = (u + 1) % 3;
            const int side = orientation_2d(a[u], a[v], b[u], b[v], c[u], c[v]);
            if (side != 0) return orientation_2d(a[u], a[v], b[u], b[v], p[u], p[v]) == -side;
        }
        return false;
    }

    /// The barycentric weights of d in the triangle abc; d may be outside it.
    std::array<double, 3> weights(const Triple& abc, Index d) const {
        const Vec3 &a = mesh_.point(abc[0]), u = mesh_.point(abc[1]) - a, v = mesh_.point(abc[2]) - a,
                   w = mesh_.point(d) - a, n = cross(u, v);
        const double area = dot(n, n), s = dot(cross(w, v), n) / area, t = dot(cross(u, w), n) / area;
        return {1 - s - t, s, t};
    }

    /// True if the fourth value is the weighted sum of the other three. Equal values match exactly; 32-bit
    /// and 64-bit floats match within their rounding error.
    static bool is_linear(const Attribute& a, const std::array<Index, 4>& at,
                          const std::array<double, 3>& weight) {
        if (is_same_value(a, at[0], at[1]) && is_same_value(a, at[0], at[2]) &&
            is_same_value(a, at[0], at[3]))
            return true;
        const bool single = std::holds_alternative<std::vector<float>>(a.data);
        if (a.role == Role::index || (!single && !std::holds_alternative<std::vector<double>>(a.data)))
            return false;
        for (int k = 0; k < a.components; ++k) {
            const double there = a.value(at[3], k);
            double sum = 0, size = std::abs(there);
            for (std::size_t i = 0; i < 3; ++i) {
                sum += weight[i] * a.value(at[i], k);
                size += std::abs(weight[i] * a.value(at[i], k));
            }
            if (!(std::abs(sum - there) <= size * (single ? 0x1p-24 : 0x1p-50))) return false;
        }
        return true;
    }

    const Mesh& mesh_;
    const TriangleFaces& triangles_;
};

class Redrawing {
  public:
    Redrawing(const Mesh& mesh, std::vector<OuterPiece> pieces, const Arrangement& arrangement,
              const TriangleFaces& triangles)
        : mesh_(mesh), pieces_(std::move(pieces)), arrangement_(arrangement), triangles_(triangles) {}

    std::vector<OuterPiece> run(const std::vector<Index>& uncut) {
        sort(pieces_);
        find_sheets();
        find_edges();
        find_needless(uncut);
        draw();
        return std::move(pieces_);
    }

  private:
    static void sort(std::vector<OuterPiece>& pieces) {
        std::stable_sort(pieces.begin(), pieces.end(),
                         [](const auto& a, const auto& b) { return a.triangles[0] < b.triangles[0]; });
    }
    Index node_of(Index triangle, std::size_t k) const {
        return mesh_.vertex(triangles_.corners[triangle][k % 3]);
    }
    Index triangle_of(Index corner) const { return pieces_[corner / 3].triangles[0]; }
    Index node_at(Index corner) const { return pieces_[corner / 3].nodes[corner % 3]; }
    Index end_of(Index corner) const { return pieces_[corner / 3].nodes[(corner + 1) % 3]; }
    /// The lowest triangle of the corner's sheet.
    Index sheet_of(Index corner) const { return sheet_[corner / 3]; }

    void find_sheets() {
        std::vector<Index> cut; // cut triangles
        for (const OuterPiece& p : pieces_)
            if (cut.empty() || cut.back() != p.triangles[0]) cut.push_back(p.triangles[0]);
        using Side = std::tuple<Index, Index, Index, Index>; // low vertex, high vertex, index in cut, corner
        std::vector<Side> all;
        for (Index i = 0; i < cut.size(); ++i)
            for (Index k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax({node_of(cut[i], k), node_of(cut[i], k + 1)});
                all.emplace_back(low, high, i, k);
            }
        std::sort(all.begin(), all.end());
        DisjointSets sets(cut.size());
        const Flatness flatness(mesh_, triangles_);
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            const auto& [low, high, i, k] = all[begin];
            while (end < all.size() && std::get<0>(all[end]) == low && std::get<1>(all[end]) == high) ++end;
            if (end != begin + 2) continue;
            const Index j = std::get<2>(all[begin + 1]), l = std::get<3>(all[begin + 1]);
            if (node_of(cut[i], k) != node_of(cut[j], l) && flatness.is_flat(cut[i], k, cut[j], l))
                sets.join(i, j);
        }
        sheet_.resize(pieces_.size());
        for (std::size_t n = 0, i = 0; n < pieces_.size(); ++n) {
            while (cut[i] != pieces_[n].triangles[0]) ++i;
            sheet_[n] = cut[sets.find(static_cast<Index>(i))];
        }
    }

    void find_edges() {
        Mesh mesh;
        mesh.positions.resize(arrangement_.node_count());
        for (const OuterPiece& p : pieces_)
            mesh.corners.insert(mesh.corners.end(), p.nodes.begin(), p.nodes.end());
        edges_ = build_edges(mesh);
        outer_.resize(arrangement_.node_count());
        for (Index e = 0; e < edges_.size(); ++e) {
            if (is_inner(e)) continue;
            const auto& [low, high] = edges_.edges[e];
            outer_[low].add(e);
            outer_[high].add(e);
        }
    }
    bool is_inner(Index e) const {
        const auto at = edges_.corners_of(e);
        return at.size() == 2 && node_at(at[0]) != node_at(at[1]) && sheet_of(at[0]) == sheet_of(at[1]);
    }

    void find_needless(const std::vector<Index>& uncut) {
        std::vector<std::uint8_t> needed(arrangement_.node_count(), 0);
        parallel_for(uncut.size(), [&](std::size_t i) {
            for (Index c = mesh_.face_begin(uncut[i]); c < mesh_.face_end(uncut[i]); ++c)
                std::atomic_ref(needed[mesh_.vertex(c)]).store(1, std::memory_order_relaxed);
        });
        const auto corners = static_cast<Index>(3 * pieces_.size());
        for (Index c = 0; c < corners; ++c)
            for (std::size_t k = 0; k < 3; ++k)
                if (node_of(triangle_of(c), k) == node_at(c)) needed[node_at(c)] = 1;
        goes_.assign(arrangement_.node_count(), 0);
        for (Index c = 0; c < corners; ++c) {
            const Index node = node_at(c);
            if (std::exchange(needed[node], 1)) continue;
            goes_[node] = outer_[node].count == 0 || (outer_[node].count == 2 && is_straight(node));
        }
    }

    Index across(Index e, Index node) const {
        const auto& [low, high] = edges_.edges[e];
        return low == node ? high : low;
    }

    /// True if both outer edges at the node are collinear.
    bool is_straight(Index node) const {
        const auto& [first, second] = outer_[node].edges;
        const auto one = sheets_at(first), other = sheets_at(second);
        if (one != other) return false;
        if (std::any_of(one.begin() + 1, one.end(), [&](Index s) { return !is_same_plane(one[0], s); }))
            return true;
        for (const Index c : edges_.corners_of(first))
            for (const Index d : edges_.corners_of(second))
                for (int k = 0; triangle_of(c) == triangle_of(d) && k < 3; ++k)
                    if (is_on(triangle_of(c), k, node) && is_on(triangle_of(c), k, across(first, node)) &&
                        is_on(triangle_of(c), k, across(second, node)))
                        return true;
        return false;
    }
    std::vector<Index> sheets_at(Index e) const {
        std::vector<Index> sheets;
        for (const Index c : edges_.corners_of(e)) sheets.push_back(sheet_of(c));
        std::sort(sheets.begin(), sheets.end());
        return sheets;
    }
    bool is_same_plane(Index s, Index t) const {
        const auto at = [&](Index of, std::size_t k) { return mesh_.positions[node_of(of, k)]; };
        for (std::size_t k = 0; k < 3; ++k)
            if (orientation_3d(at(s, 0), at(s, 1), at(s, 2), at(t, k)) != 0) return false;
        return true;
    }
    bool is_on(Index triangle, int side, Index node) const {
        const auto k = static_cast<std::size_t>(side);
        return node == node_of(triangle, k) || node == node_of(triangle, k + 1) ||
               arrangement_.side_of(triangle, node) == side;
    }

    /// The next node that stays, along the line from one node to the other.
    Index along(Index from, Index to) const {
        while (goes_[to]) {
            const auto& [first, second] = outer_[to].edges;
            from = std::exchange(to, across(across(first, to) == from ? second : first, to));
        }
        return to;
    }

    void draw() {
        std::map<Index, Index> number; // numbers of sheets that lose nodes
        for (Index c = 0; c < 3 * pieces_.size(); ++c)
            if (goes_[node_at(c)]) number.try_emplace(sheet_of(c), none);
        std::vector<Arrangement::Region> regions;
        for (auto& [sheet, n] : number) {
            n = static_cast<Index>(regions.size());
            regions.push_back({sheet, {}, {}});
        }
        std::vector<std::map<Index, Index>> holders(
            regions.size()); // per region: a triangle of the sheet for each node
        std::vector<OuterPiece> drawn;
        for (Index i = 0; i < pieces_.size(); ++i) {
            const auto at = number.find(sheet_[i]);
            if (at == number.end())
                drawn.push_back(pieces_[i]);
            else
                add(regions[at->second], holders[at->second], i);
        }
        const auto filled = arrangement_.fill(regions);
        for (std::size_t r = 0; r < regions.size(); ++r) {
            if (!filled[r]) return; // retriangulation failed: all pieces stay
            for (const auto& [a, b, c] : *filled[r])
                drawn.push_back({{a, b, c}, {holders[r].at(a), holders[r].at(b), holders[r].at(c)}});
        }
        sort(drawn);
        pieces_ = std::move(drawn);
    }

    void add(Arrangement::Region& region, std::map<Index, Index>& holder, Index piece) const {
        for (Index c = 3 * piece; c < 3 * piece + 3; ++c) {
            const Index node = node_at(c), triangle = triangle_of(c);
            if (goes_[node]) continue;
            region.points.push_back(node);
            const auto [at, fresh] = holder.try_emplace(node, triangle);
            if (!fresh && !has_corner(at->second, node) && has_corner(triangle, node)) at->second = triangle;
            if (!is_inner(edges_.corner_edge[c])) region.border.push_back({node, along(node, end_of(c))});
        }
    }
    bool has_corner(Index triangle, Index node) const {
        return node_of(triangle, 0) == node || node_of(triangle, 1) == node || node_of(triangle, 2) == node;
    }

    /// The number of outer edges at a node, and the first two.
    struct Outer {
        Index count = 0;
        std::array<Index, 2> edges{};
        void add(Index e) {
            if (count < 2) edges[count] = e;
            ++count;
        }
    };

    const Mesh& mesh_;
    std::vector<OuterPiece> pieces_;
    const Arrangement& arrangement_;
    const TriangleFaces& triangles_;
    std::vector<Index> sheet_;       ///< [pieces] the sheet
    EdgeTable edges_;                ///< edges of the pieces; corner 3 i + k is corner k of piece i
    std::vector<Outer> outer_;       ///< [nodes] outer edges
    std::vector<std::uint8_t> goes_; ///< [nodes] 1 for removed nodes
};

} // namespace

std::vector<OuterPiece> redrawn(const Mesh& mesh, const std::vector<Index>& uncut,
                                std::vector<OuterPiece> pieces, const Arrangement& arrangement,
                                const TriangleFaces& triangles) {
    return Redrawing(mesh, std::move(pieces), arrangement, triangles).run(uncut);
}

} // namespace facetmill::clean_steps
