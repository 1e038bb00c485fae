#include "geometry/boolean/boolean_pass.hpp"

#include "geometry/boolean/buried.hpp"
#include "geometry/boolean/redrawn.hpp"
#include "geometry/boolean/united_mesh.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/indices_where.hpp"
#include "mesh/surface.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::clean_steps {

namespace {

constexpr const char* inside_out = "a component is inside out and is not a cavity of a solid around it: use "
                                   "orient first to decide which side is inside";
constexpr const char* turned_by_rounding =
    "faces run along each other so closely that rounding the coordinates of the union turns pieces over";
/// A winding number, split into outward and inward components.
struct Winding {
    int outward = 0, inward = 0;
    int all() const { return outward + inward; }
    void add(bool of_inward, int turn) { (of_inward ? inward : outward) += turn; }
    bool operator==(const Winding&) const = default;
};

/// The operands' winding numbers on one side of a patch. Without operands, all components belong to the
/// first.
using Sides = std::array<Winding, 2>;

Sides sum(Sides a, const Sides& b) {
    for (std::size_t k = 0; k < 2; ++k) {
        a[k].outward += b[k].outward;
        a[k].inward += b[k].inward;
    }
    return a;
}

bool encloses(const Sides& sides, const Operands* operands) {
    const int first = sides[0].all(), second = sides[1].all();
    if (!operands) return first >= 1;
    switch (operands->operation) {
    case CombineOperation::unite:
        return first >= 1 || second >= 1;
    case CombineOperation::intersect:
        return first >= 1 && second >= 1;
    case CombineOperation::subtract:
        break;
    }
    return first >= 1 && second > -1;
}

/// An uncut face, or a piece of cut faces, oriented like the majority of its source triangles.
struct Leaf {
    std::array<Index, 3> nodes;
    Index first = none;   ///< a source of the same orientation, unless they cancel
    Index against = none; ///< the first source of the opposite orientation
    Index cluster = none;
    Sides turns; ///< sources of the same orientation, minus sources of the opposite one
    std::array<bool, 2> of_inward{};
};

enum class Fate : std::uint8_t { goes, stays, stays_turned };

class BooleanPass {
  public:
    BooleanPass(Mesh& mesh, const Solids& solids, const SelfIntersections& found,
                const SnapTolerance& rounding, const Operands* operands, const PassBudget& effort)
        : mesh_(mesh), solids_(solids), found_(found), rounding_(rounding), operands_(operands),
          effort_(effort) {}

    United run() {
        gather();
        mark_cut_faces();
        merge_where_cut();
        TriangleSoup soup = triangle_soup();
        result_.pairs = soup.pairs.size();
        if (refuse_for_memory(soup)) return std::move(result_);
        const bool is_short = soup.max_crossings < effort_.crossings && soup.pairs.size() <= soup.max_pairs;
        Arrangement arrangement(std::move(soup));
        if (const auto full = arrangement.overfull()) {
            result_.short_of_memory = is_short;
            refuse(cluster_of(*full), is_short ? lack_of_memory(result_.pairs) : effort_.too_many);
            return std::move(result_);
        }
        make_leaves(arrangement);
        find_patches(arrangement);
        judge_patches(arrangement);
        if (result_.refused.empty()) assemble(arrangement);
        return std::move(result_);
    }

  private:
    Index component_of(Index triangle) const { return solids_.components.of_face[triangles_.face[triangle]]; }
    Index cluster_of(Index triangle) const { return solids_.cluster[component_of(triangle)]; }
    std::size_t operand_of(Index component) const {
        return operands_ && operands_->second[component] ? 1 : 0;
    }
    void count(Sides& sides, Index triangle, int turn) const {
        const Index p = component_of(triangle);
        sides[operand_of(p)].add(solids_.inward[p], turn);
    }

    void refuse(Index cluster, const std::string& why) {
        for (const auto& r : result_.refused)
            if (r.cluster == cluster) return;
        result_.refused.push_back({cluster, why});
    }

    static std::string lack_of_memory(std::size_t pairs) {
        return fmt::format("there is not enough memory to cut {} pairs of intersecting triangles along each "
                           "other",
                           pairs);
    }

    bool refuse_for_memory(TriangleSoup& soup) {
        constexpr double bytes_a_pair = 1700, bytes_a_triangle = 100,
                         bytes_a_crossing = 100; // measured memory
        double left = effort_.memory ? static_cast<double>(*effort_.memory) : HUGE_VAL;
        left -= bytes_a_pair * static_cast<double>(soup.pairs.size()) +
                bytes_a_triangle * static_cast<double>(soup.triangles.size());
        if (left > 0) {
            soup.max_pairs = effort_.pairs;
            soup.max_crossings = std::min(effort_.crossings,
                                          static_cast<std::size_t>(std::min(left / bytes_a_crossing, 1e18)));
            return false;
        }
        for (Index c = 0; c < solids_.clusters(); ++c) refuse(c, lack_of_memory(soup.pairs.size()));
        result_.short_of_memory = true;
        return true;
    }

    void mark_cut_faces() {
        const Buried& buried = buried_.emplace(mesh_, solids_, found_, triangles_, first_, operands_);
        const auto is_closed = [&](const auto& pair) {
            return solids_.cluster_of_face(pair.first) != none &&
                   solids_.cluster_of_face(pair.second) != none;
        };
        std::copy_if(found_.pairs.begin(), found_.pairs.end(), std::back_inserter(pairs_), is_closed);
        const auto held = buried.hold_meetings(pairs_);
        std::size_t count = 0;
        for (std::size_t i = 0; i < held.size(); ++i)
            if (!held[i]) pairs_[count++] = pairs_[i];
        pairs_.resize(count);
        cut_.assign(mesh_.face_count(), 0);
        for (const auto& [f, g] : pairs_) cut_[f] = cut_[g] = 1;
    }

    void merge_where_cut() {
        if (!solids_.rings.empty()) return; // rings are known only if no two vertices have the same position
        auto target = lowest_at_place(mesh_);
        std::vector<std::uint8_t> touched(mesh_.vertex_count(), 0);
        for (Index f = 0; f < mesh_.face_count(); ++f)
            for (Index c = mesh_.face_begin(f); cut_[f] && c < mesh_.face_end(f); ++c)
                touched[target[mesh_.vertex(c)]] = 1;
        for (Index v = 0; v < target.size(); ++v)
            if (!touched[target[v]]) target[v] = v;
        merge_vertices(mesh_, target);
    }

    /// Collects the triangles of all closed components.
    void gather() {
        const bool plain = mesh_.all_triangles();
        const Surface surface = plain ? Surface{} : surface_of(mesh_);
        const std::size_t count = plain ? mesh_.face_count() : surface.size();
        const auto face_of = [&](std::size_t t) { return plain ? static_cast<Index>(t) : surface.face(t); };
        const std::vector<Index> chosen = indices_where(
            count, [&](Index t) { return solids_.closed[solids_.components.of_face[face_of(t)]] != 0; });
        first_.assign(mesh_.face_count() + 1, 0);
        for (const Index t : chosen) ++first_[face_of(t) + 1];
        for (std::size_t f = 0; f < mesh_.face_count(); ++f) first_[f + 1] += first_[f];
        triangles_.face.resize(chosen.size());
        triangles_.corners.resize(chosen.size());
        parallel_for(chosen.size(), [&](std::size_t i) {
            const Index f = face_of(chosen[i]), begin = mesh_.face_begin(f);
            triangles_.face[i] = f;
            for (Index k = 0; k < 3; ++k) {
                Index& corner = triangles_.corners[i][k];
                corner = begin + k;
                for (Index c = begin; !plain && c < mesh_.face_end(f); ++c)
                    if (mesh_.vertex(c) == surface.corners[std::size_t{3} * chosen[i] + k]) corner = c;
            }
        });
    }

    std::array<Index, 3> nodes_of(Index t) const {
        const auto& c = triangles_.corners[t];
        return {mesh_.vertex(c[0]), mesh_.vertex(c[1]), mesh_.vertex(c[2])};
    }
    bool has_area(Index t) const {
        const auto n = nodes_of(t);
        return !is_degenerate(mesh_.positions[n[0]], mesh_.positions[n[1]], mesh_.positions[n[2]]);
    }

    TriangleSoup triangle_soup() const {
        TriangleSoup soup;
        soup.points = mesh_.positions;
        soup.triangles.resize(triangles_.face.size());
        parallel_for(soup.triangles.size(),
                     [&](std::size_t t) { soup.triangles[t] = nodes_of(static_cast<Index>(t)); });
        for (Index f = 0; f < cut_.size(); ++f)
            for (Index t = first_[f]; cut_[f] && t < first_[f + 1]; ++t) soup.cut.push_back(t);
        const auto box = [&](Index t) {
            Box b;
            for (const Index v : soup.triangles[t]) b.add(mesh_.positions[v]);
            return b;
        };
        for (const auto& [f, g] : pairs_)
            for (Index s = first_[f]; s < first_[f + 1]; ++s)
                for (Index t = first_[g]; t < first_[g + 1]; ++t)
                    if (boxes_meet(box(s), box(t))) soup.pairs.emplace_back(s, t);
        for (Index f = 0; f < cut_.size(); ++f) // a polygon may have a triangle without area
            for (Index s = first_[f]; cut_[f] && s < first_[f + 1]; ++s)
                for (Index t = first_[f]; !has_area(s) && t < first_[f + 1]; ++t)
                    if (s != t) soup.pairs.emplace_back(s, t);
        return soup;
    }

    // Leaves are numbered: the uncut faces, ascending, then the pieces.

    void make_leaves(const Arrangement& arrangement) {
        uncut_ = indices_where(mesh_.face_count(),
                               [&](Index f) { return !cut_[f] && solids_.cluster_of_face(f) != none; });
        pieces_.reserve(arrangement.pieces().size());
        for (const auto& piece : arrangement.pieces()) pieces_.push_back(leaf_of(piece.nodes, piece.sources));
    }
    std::size_t leaf_count() const { return uncut_.size() + pieces_.size(); }

    /// The triangle that represents an uncut face: the first with area.
    Index triangle_of(Index face) const {
        Index t = first_[face];
        while (t + 1 < first_[face + 1] && !has_area(t)) ++t;
        return t;
    }
    Leaf leaf(Index i) const {
        if (i >= uncut_.size()) return pieces_[i - uncut_.size()];
        const Index t = triangle_of(uncut_[i]);
        return leaf_of(nodes_of(t), std::array{Arrangement::Source{t, 1}});
    }
    std::vector<Index> sources_of(const Arrangement& arrangement, Index i) const {
        if (i < uncut_.size()) return {triangle_of(uncut_[i])};
        std::vector<Index> triangles;
        for (const auto& s : arrangement.pieces()[i - uncut_.size()].sources) triangles.push_back(s.triangle);
        return triangles;
    }

    Leaf leaf_of(std::array<Index, 3> nodes, std::span<const Arrangement::Source> sources) const {
        int sum = 0;
        for (const auto& s : sources) sum += s.sign;
        const int flip = sum < 0 ? -1 : 1;
        if (sum < 0) std::swap(nodes[1], nodes[2]);
        Leaf leaf;
        leaf.nodes = nodes;
        leaf.cluster = cluster_of(sources[0].triangle);
        leaf.first = sources[0].triangle;
        for (const auto& [t, sign] : sources) {
            const Index p = component_of(t);
            leaf.of_inward[operand_of(p)] |= solids_.inward[p] != 0;
            count(leaf.turns, t, flip * sign);
            if (flip * sign < 0 && leaf.against == none) leaf.against = t;
            if (flip * sign > 0 && flip * sources[0].sign < 0 && leaf.first == sources[0].triangle)
                leaf.first = t;
        }
        return leaf;
    }

    /// Finds patches: leaves connected by edges without other leaves. They have the same winding numbers on
    /// their sides.
    void find_patches(const Arrangement& arrangement) {
        std::vector<std::uint8_t> merged(mesh_.vertex_count(), 0); // vertices that may have been merged
        for (Index f = 0; f < mesh_.face_count(); ++f)
            for (Index c = mesh_.face_begin(f); cut_[f] && c < mesh_.face_end(f); ++c)
                merged[mesh_.vertex(c)] = 1;
        join_uncut(merged);
        DisjointSets sets(leaf_count());
        join_rest(arrangement, merged, sets);
        parallel_for(patch_.size(), [&](std::size_t i) { patch_[i] = sets.find(patch_[i]); });
    }

    /// Joins uncut faces along edges that got no additional faces. patch_ becomes the lowest leaf of each
    /// set. All edges around a ring that no cut face touches are such edges.
    void join_uncut(const std::vector<std::uint8_t>& merged) {
        Rings calm = solids_.rings;
        parallel_for(calm.size(), [&](std::size_t v) { calm[v] = calm[v] && !merged[v]; });
        const auto is_leaf = [&](Index f) { return !cut_[f] && solids_.cluster_of_face(f) != none; };
        FaceSets sets(mesh_, calm, is_leaf);
        const auto faces = corner_faces(mesh_);
        parallel_for(solids_.edges.size(), [&](std::size_t e) {
            const auto at = solids_.edges.corners_of(static_cast<Index>(e));
            if (at.size() != 2 || mesh_.vertex(at[0]) == mesh_.vertex(at[1])) return;
            const Index f = faces[at[0]], g = faces[at[1]];
            if (!is_leaf(f) || !is_leaf(g)) return;
            if (merged[mesh_.vertex(at[0])] && merged[mesh_.vertex(next_corner(mesh_, f, at[0]))]) return;
            sets.join(f, g);
        });
        patch_.resize(leaf_count());
        parallel_for(patch_.size(), [&](std::size_t i) {
            patch_[i] = i < uncut_.size() ? sets.find(uncut_[i]) : static_cast<Index>(i);
        });
        std::vector<Index> lowest(sets.bound(), none);
        for (Index i = 0; i < uncut_.size(); ++i) {
            Index& first = lowest[patch_[i]];
            if (first == none) first = i;
            patch_[i] = first;
        }
    }

    /// Joins leaves along edges of pieces, and along edges between vertices that may have been merged.
    void join_rest(const Arrangement& arrangement, const std::vector<std::uint8_t>& merged,
                   DisjointSets& sets) const {
        Mesh mesh;
        std::vector<Index> leaf_of_face;
        mesh.positions.resize(arrangement.node_count());
        mesh.face_offsets.push_back(0);
        const auto end_face = [&](std::size_t i) {
            mesh.face_offsets.push_back(static_cast<Index>(mesh.corners.size()));
            leaf_of_face.push_back(static_cast<Index>(i));
        };
        const auto has_merged_edge = [&](Index i) {
            std::size_t count = 0;
            for (Index c = mesh_.face_begin(uncut_[i]); c < mesh_.face_end(uncut_[i]); ++c)
                count += merged[mesh_.vertex(c)];
            return count >= 2;
        };
        for (const Index i : indices_where(uncut_.size(), has_merged_edge)) {
            for (Index c = mesh_.face_begin(uncut_[i]); c < mesh_.face_end(uncut_[i]); ++c)
                mesh.corners.push_back(mesh_.vertex(c));
            end_face(i);
        }
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            mesh.corners.insert(mesh.corners.end(), pieces_[i].nodes.begin(), pieces_[i].nodes.end());
            end_face(uncut_.size() + i);
        }
        const auto edges = build_edges(mesh);
        const auto faces = corner_faces(mesh);
        const auto may_be_another = [&](Index v) { return v >= merged.size() || merged[v]; };
        for (Index e = 0; e < edges.size(); ++e) {
            const auto at = edges.corners_of(e);
            if (at.size() != 2 || mesh.corners[at[0]] == mesh.corners[at[1]]) continue;
            if (!may_be_another(edges.edges[e].low) || !may_be_another(edges.edges[e].high)) continue;
            const Index i = leaf_of_face[faces[at[0]]], j = leaf_of_face[faces[at[1]]];
            const Leaf a = leaf(i), b = leaf(j);
            if (a.turns == b.turns && a.of_inward == b.of_inward) sets.join(patch_[i], patch_[j]);
        }
    }

    /// The winding numbers in front of a leaf. Components outside the cluster count only if the cluster
    /// contains a cavity.
    Sides front_of(const Leaf& leaf, const Arrangement::Seen& seen) const {
        Sides ahead;
        int around = 0;
        for (const auto& [t, turn] : seen.hits)
            if (cluster_of(t) != leaf.cluster)
                around += turn;
            else
                count(ahead, t, turn);
        if (seen.way < 0)
            for (std::size_t k = 0; k < 2; ++k) {
                ahead[k].outward -= leaf.turns[k].outward;
                ahead[k].inward -= leaf.turns[k].inward;
            }
        if (has_cavity_[leaf.cluster] && around > 0) ++ahead[0].outward;
        return ahead;
    }

    /// The lower winding number of the outward components on both sides.
    int least_around(const Sides& front, const Sides& back, std::size_t operand) const {
        const bool reversed = operand == 1 && operands_->operation == CombineOperation::subtract;
        const int sign = reversed ? -1 : 1;
        return std::min(sign * front[operand].outward, sign * back[operand].outward);
    }

    /// True if the centre of a leaf is certainly in a region from which all faces are removed.
    bool is_buried(const Arrangement& arrangement, Index i) const {
        if (!buried_->takes_all()) return false;
        const Leaf l = leaf(i);
        std::array<Vec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = arrangement.position(l.nodes[k]);
        const Vec3 centre = (at[0] + at[1] + at[2]) / 3;
        const double largest = std::max({length(at[0]), length(at[1]), length(at[2])});
        return buried_->holds_point({centre, 0x1p-49 * largest}, l.cluster);
    }

    void judge_patches(const Arrangement& arrangement) {
        has_cavity_.assign(solids_.clusters(), 0);
        for (Index p = 0; p < solids_.components.count; ++p)
            if (solids_.cluster[p] != none && solids_.inward[p]) has_cavity_[solids_.cluster[p]] = 1;
        std::vector<Index> firsts; // the lowest leaf of each patch
        std::vector<Arrangement::Look> looks;
        for (Index i = 0; i < leaf_count(); ++i) {
            if (patch_[i] != i || is_buried(arrangement, i)) continue;
            firsts.push_back(i);
            looks.push_back({leaf(i).nodes, sources_of(arrangement, i)});
        }
        const auto seen = arrangement.look_ahead(looks);
        fate_.assign(leaf_count(), Fate::goes);
        for (std::size_t n = 0; n < firsts.size(); ++n) {
            const Leaf first = leaf(firsts[n]);
            const Sides front = front_of(first, seen[n]), back = sum(front, first.turns);
            for (std::size_t k = 0; k < 2; ++k)
                if (first.of_inward[k] && least_around(front, back, k) < 1)
                    refuse(first.cluster, rounding_.tolerance > 0 ? turned_by_rounding : inside_out);
            const bool before = encloses(front, operands_), behind = encloses(back, operands_);
            if (before != behind) fate_[firsts[n]] = behind ? Fate::stays : Fate::stays_turned;
        }
        parallel_for(leaf_count(), [&](std::size_t i) {
            if (patch_[i] != i) fate_[i] = fate_[patch_[i]];
        });
        find_filled_cavities(arrangement);
    }

    /// Finds uncut cavities that another solid of a cluster fills; they are removed.
    void find_filled_cavities(const Arrangement& arrangement) {
        filled_.assign(solids_.components.count, 0);
        std::vector<std::uint8_t> asked(solids_.components.count, 0);
        bool any = false;
        for (Index p = 0; p < asked.size(); ++p) any |= solids_.cluster[p] == none && solids_.inward[p];
        if (!any) return;
        std::vector<Arrangement::Look> looks;
        for (Index t = 0; t < triangles_.face.size(); ++t) {
            const Index p = component_of(t);
            if (asked[p] || solids_.cluster[p] != none || !solids_.inward[p] || !has_area(t)) continue;
            asked[p] = 1;
            looks.push_back({nodes_of(t), {t}});
        }
        const auto seen = arrangement.look_ahead(looks);
        for (std::size_t i = 0; i < looks.size(); ++i) {
            std::vector<int> winding(solids_.clusters(), 0);
            for (const auto& [hit, turn] : seen[i].hits)
                if (cluster_of(hit) != none) winding[cluster_of(hit)] += turn;
            for (const int w : winding) filled_[component_of(looks[i].but[0])] |= w >= 2;
        }
    }

    static OuterPiece piece_of(const std::array<Index, 3>& nodes, Index triangle) {
        return {nodes, {triangle, triangle, triangle}};
    }

    void assemble(const Arrangement& arrangement) {
        std::vector<std::uint8_t> goes = cut_;
        const bool any_filled = std::find(filled_.begin(), filled_.end(), 1) != filled_.end();
        for (Index f = 0; any_filled && f < goes.size(); ++f)
            if (filled_[solids_.components.of_face[f]]) {
                goes[f] = 1;
                ++result_.covered_faces;
            }
        std::vector<OuterPiece> pieces;
        const auto covered = indices_where(uncut_.size(), [&](Index i) { return fate_[i] == Fate::goes; });
        for (const Index i : covered) goes[uncut_[i]] = 1;
        result_.covered_faces += covered.size();
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            const Leaf& leaf = pieces_[i];
            const Fate fate = fate_[uncut_.size() + i];
            const auto& [a, b, c] = leaf.nodes;
            if (fate == Fate::stays) pieces.push_back(piece_of(leaf.nodes, leaf.first));
            if (fate == Fate::stays_turned) pieces.push_back(piece_of({a, c, b}, leaf.against));
        }
        result_.cut_faces = static_cast<std::size_t>(std::count(cut_.begin(), cut_.end(), 1));
        const auto uncut = faces_without(goes);
        result_.uncut_faces = uncut.size();
        pieces = redrawn(mesh_, uncut, std::move(pieces), arrangement, triangles_);
        UnitedMesh united = united_mesh(mesh_, uncut, pieces, arrangement, triangles_, rounding_);
        result_.settled = settled(goes, united);
        result_.mesh = std::move(united.mesh);
        result_.changes = std::move(united.changes);
    }

    std::vector<std::uint8_t> settled(const std::vector<std::uint8_t>& goes, const UnitedMesh& united) const {
        if (solids_.rings.empty()) return {};
        Rings whole = solids_.rings;
        for (Index f = 0; f < goes.size(); ++f)
            for (Index c = mesh_.face_begin(f); goes[f] && c < mesh_.face_end(f); ++c)
                whole[mesh_.vertex(c)] = 0;
        std::vector<std::uint8_t> settled(united.mesh.vertex_count(), 0);
        parallel_for(united.old_vertices.size(),
                     [&](std::size_t v) { settled[v] = whole[united.old_vertices[v]]; });
        return settled;
    }

    Mesh& mesh_; ///< vertices are merged where faces are cut
    const Solids& solids_;
    const SelfIntersections& found_;
    SnapTolerance rounding_;
    const Operands* operands_; ///< may be null
    const PassBudget& effort_;
    std::optional<Buried> buried_;               ///< set once triangles are gathered
    std::vector<std::uint8_t> cut_;              ///< [faces] 1 for faces to cut
    std::vector<std::pair<Index, Index>> pairs_; ///< pairs of faces to cut
    TriangleFaces triangles_;                    ///< triangles of closed components
    std::vector<Index> first_;                   ///< [faces + 1] offsets into triangles_
    std::vector<Index> uncut_;                   ///< uncut faces
    std::vector<Leaf> pieces_;                   ///< in the arrangement's order
    std::vector<Index> patch_;                   ///< [leaves] the lowest leaf of the same patch
    std::vector<std::uint8_t> has_cavity_;       ///< [clusters] 1 if it has an inward component
    std::vector<Fate> fate_;                     ///< [leaves] fates
    std::vector<std::uint8_t> filled_;           ///< [components] 1 for filled cavities
    United result_;
};

} // namespace

United unite(Mesh& mesh, const Solids& solids, const SelfIntersections& found, const SnapTolerance& rounding,
             const Operands* operands, const PassBudget& effort) {
    return BooleanPass(mesh, solids, found, rounding, operands, effort).run();
}

} // namespace facetmill::clean_steps
