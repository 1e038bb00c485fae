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

/// The triangles of all closed components.
struct ClosedTriangles {
    Mesh& mesh; ///< vertices are merged where faces are cut
    const Solids& solids;
    const Operands* operands; ///< may be null
    TriangleFaces triangles{};
    std::vector<Index> first{}; ///< [faces + 1] offsets into triangles

    Index component_of(Index triangle) const { return solids.components.of_face[triangles.face[triangle]]; }
    Index cluster_of(Index triangle) const { return solids.cluster[component_of(triangle)]; }
    std::size_t operand_of(Index component) const { return operands && operands->second[component] ? 1 : 0; }
    void count(Sides& sides, Index triangle, int turn) const {
        const Index p = component_of(triangle);
        sides[operand_of(p)].add(solids.inward[p], turn);
    }
    std::array<Index, 3> nodes_of(Index t) const {
        const auto& c = triangles.corners[t];
        return {mesh.vertex(c[0]), mesh.vertex(c[1]), mesh.vertex(c[2])};
    }
    bool has_area(Index t) const {
        const auto n = nodes_of(t);
        return !is_degenerate(mesh.positions[n[0]], mesh.positions[n[1]], mesh.positions[n[2]]);
    }
    /// The triangle that represents an uncut face: the first with area.
    Index triangle_of(Index face) const {
        Index t = first[face];
        while (t + 1 < first[face + 1] && !has_area(t)) ++t;
        return t;
    }
};

/// Collects the triangles of all closed components.
void gather(ClosedTriangles& c) {
    const bool plain = c.mesh.all_triangles();
    const Surface surface = plain ? Surface{} : surface_of(c.mesh);
    const std::size_t count = plain ? c.mesh.face_count() : surface.size();
    const auto face_of = [&](std::size_t t) { return plain ? static_cast<Index>(t) : surface.face(t); };
    const std::vector<Index> chosen = indices_where(
        count, [&](Index t) { return c.solids.closed[c.solids.components.of_face[face_of(t)]] != 0; });
    c.first.assign(c.mesh.face_count() + 1, 0);
    for (const Index t : chosen) ++c.first[face_of(t) + 1];
    for (std::size_t f = 0; f < c.mesh.face_count(); ++f) c.first[f + 1] += c.first[f];
    c.triangles.face.resize(chosen.size());
    c.triangles.corners.resize(chosen.size());
    parallel_for(chosen.size(), [&](std::size_t i) {
        const Index f = face_of(chosen[i]), begin = c.mesh.face_begin(f);
        c.triangles.face[i] = f;
        for (Index k = 0; k < 3; ++k) {
            Index& corner = c.triangles.corners[i][k];
            corner = begin + k;
            for (Index v = begin; !plain && v < c.mesh.face_end(f); ++v)
                if (c.mesh.vertex(v) == surface.corners[std::size_t{3} * chosen[i] + k]) corner = v;
        }
    });
}

/// The faces that others cut.
struct FacesToCut {
    std::vector<std::uint8_t> cut;              ///< [faces] 1 for faces to cut
    std::vector<std::pair<Index, Index>> pairs; ///< pairs of faces to cut
};

FacesToCut faces_to_cut(const ClosedTriangles& c, const SelfIntersections& found, const Buried& buried) {
    FacesToCut cuts;
    const auto is_closed = [&](const auto& pair) {
        return c.solids.cluster_of_face(pair.first) != none && c.solids.cluster_of_face(pair.second) != none;
    };
    std::copy_if(found.pairs.begin(), found.pairs.end(), std::back_inserter(cuts.pairs), is_closed);
    const auto held = buried.hold_meetings(cuts.pairs);
    std::size_t count = 0;
    for (std::size_t i = 0; i < held.size(); ++i)
        if (!held[i]) cuts.pairs[count++] = cuts.pairs[i];
    cuts.pairs.resize(count);
    cuts.cut.assign(c.mesh.face_count(), 0);
    for (const auto& [f, g] : cuts.pairs) cuts.cut[f] = cuts.cut[g] = 1;
    return cuts;
}

void merge_where_cut(ClosedTriangles& c, const std::vector<std::uint8_t>& cut) {
    if (!c.solids.rings.empty()) return; // rings are known only if no two vertices have the same position
    auto target = lowest_at_place(c.mesh);
    std::vector<std::uint8_t> touched(c.mesh.vertex_count(), 0);
    for (Index f = 0; f < c.mesh.face_count(); ++f)
        for (Index k = c.mesh.face_begin(f); cut[f] && k < c.mesh.face_end(f); ++k)
            touched[target[c.mesh.vertex(k)]] = 1;
    for (Index v = 0; v < target.size(); ++v)
        if (!touched[target[v]]) target[v] = v;
    merge_vertices(c.mesh, target);
}

TriangleSoup triangle_soup(const ClosedTriangles& c, const FacesToCut& cuts) {
    TriangleSoup soup;
    soup.points = c.mesh.positions;
    soup.triangles.resize(c.triangles.face.size());
    parallel_for(soup.triangles.size(),
                 [&](std::size_t t) { soup.triangles[t] = c.nodes_of(static_cast<Index>(t)); });
    for (Index f = 0; f < cuts.cut.size(); ++f)
        for (Index t = c.first[f]; cuts.cut[f] && t < c.first[f + 1]; ++t) soup.cut.push_back(t);
    const auto box = [&](Index t) {
        Box b;
        for (const Index v : soup.triangles[t]) b.add(c.mesh.positions[v]);
        return b;
    };
    for (const auto& [f, g] : cuts.pairs)
        for (Index s = c.first[f]; s < c.first[f + 1]; ++s)
            for (Index t = c.first[g]; t < c.first[g + 1]; ++t)
                if (boxes_meet(box(s), box(t))) soup.pairs.emplace_back(s, t);
    for (Index f = 0; f < cuts.cut.size(); ++f) // a polygon may have a triangle without area
        for (Index s = c.first[f]; cuts.cut[f] && s < c.first[f + 1]; ++s)
            for (Index t = c.first[f]; !c.has_area(s) && t < c.first[f + 1]; ++t)
                if (s != t) soup.pairs.emplace_back(s, t);
    return soup;
}

Leaf leaf_of(const ClosedTriangles& c, std::array<Index, 3> nodes,
             std::span<const Arrangement::Source> sources) {
    int sum = 0;
    for (const auto& s : sources) sum += s.sign;
    const int flip = sum < 0 ? -1 : 1;
    if (sum < 0) std::swap(nodes[1], nodes[2]);
    Leaf leaf;
    leaf.nodes = nodes;
    leaf.cluster = c.cluster_of(sources[0].triangle);
    leaf.first = sources[0].triangle;
    for (const auto& [t, sign] : sources) {
        const Index p = c.component_of(t);
        leaf.of_inward[c.operand_of(p)] |= c.solids.inward[p] != 0;
        c.count(leaf.turns, t, flip * sign);
        if (flip * sign < 0 && leaf.against == none) leaf.against = t;
        if (flip * sign > 0 && flip * sources[0].sign < 0 && leaf.first == sources[0].triangle)
            leaf.first = t;
    }
    return leaf;
}

/// The uncut faces, ascending, then the pieces in the arrangement's order.
struct Leaves {
    const ClosedTriangles& c;
    std::vector<Index> uncut;
    std::vector<Leaf> pieces{};

    std::size_t count() const { return uncut.size() + pieces.size(); }
    Leaf leaf(Index i) const {
        if (i >= uncut.size()) return pieces[i - uncut.size()];
        const Index t = c.triangle_of(uncut[i]);
        return leaf_of(c, c.nodes_of(t), std::array{Arrangement::Source{t, 1}});
    }
    std::vector<Index> sources_of(const Arrangement& arrangement, Index i) const {
        if (i < uncut.size()) return {c.triangle_of(uncut[i])};
        std::vector<Index> triangles;
        for (const auto& s : arrangement.pieces()[i - uncut.size()].sources) triangles.push_back(s.triangle);
        return triangles;
    }
};

bool is_uncut(const ClosedTriangles& c, const std::vector<std::uint8_t>& cut, Index face) {
    return !cut[face] && c.solids.cluster_of_face(face) != none;
}

Leaves leaves_of(const ClosedTriangles& c, const std::vector<std::uint8_t>& cut,
                 const Arrangement& arrangement) {
    Leaves leaves{c, indices_where(c.mesh.face_count(), [&](Index f) { return is_uncut(c, cut, f); })};
    leaves.pieces.reserve(arrangement.pieces().size());
    for (const auto& piece : arrangement.pieces())
        leaves.pieces.push_back(leaf_of(c, piece.nodes, piece.sources));
    return leaves;
}

/// Joins uncut faces along edges that got no additional faces, and returns the lowest leaf of the set of
/// each leaf. All edges around a ring that no cut face touches are such edges.
std::vector<Index> join_uncut(const Leaves& leaves, const std::vector<std::uint8_t>& cut,
                              const std::vector<std::uint8_t>& merged) {
    const ClosedTriangles& c = leaves.c;
    Rings calm = c.solids.rings;
    parallel_for(calm.size(), [&](std::size_t v) { calm[v] = calm[v] && !merged[v]; });
    const auto is_leaf = [&](Index f) { return is_uncut(c, cut, f); };
    FaceSets sets(c.mesh, calm, is_leaf);
    const auto faces = corner_faces(c.mesh);
    parallel_for(c.solids.edges.size(), [&](std::size_t e) {
        const auto at = c.solids.edges.corners_of(static_cast<Index>(e));
        if (at.size() != 2 || c.mesh.vertex(at[0]) == c.mesh.vertex(at[1])) return;
        const Index f = faces[at[0]], g = faces[at[1]];
        if (!is_leaf(f) || !is_leaf(g)) return;
        if (merged[c.mesh.vertex(at[0])] && merged[c.mesh.vertex(next_corner(c.mesh, f, at[0]))]) return;
        sets.join(f, g);
    });
    std::vector<Index> patch(leaves.count());
    parallel_for(patch.size(), [&](std::size_t i) {
        patch[i] = i < leaves.uncut.size() ? sets.find(leaves.uncut[i]) : static_cast<Index>(i);
    });
    std::vector<Index> lowest(sets.bound(), none);
    for (Index i = 0; i < leaves.uncut.size(); ++i) {
        Index& first = lowest[patch[i]];
        if (first == none) first = i;
        patch[i] = first;
    }
    return patch;
}

/// Joins leaves along edges of pieces, and along edges between vertices that may have been merged.
void join_rest(const Leaves& leaves, const Arrangement& arrangement, const std::vector<std::uint8_t>& merged,
               const std::vector<Index>& patch, DisjointSets& sets) {
    const ClosedTriangles& c = leaves.c;
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
        for (Index k = c.mesh.face_begin(leaves.uncut[i]); k < c.mesh.face_end(leaves.uncut[i]); ++k)
            count += merged[c.mesh.vertex(k)];
        return count >= 2;
    };
    for (const Index i : indices_where(leaves.uncut.size(), has_merged_edge)) {
        for (Index k = c.mesh.face_begin(leaves.uncut[i]); k < c.mesh.face_end(leaves.uncut[i]); ++k)
            mesh.corners.push_back(c.mesh.vertex(k));
        end_face(i);
    }
    for (std::size_t i = 0; i < leaves.pieces.size(); ++i) {
        mesh.corners.insert(mesh.corners.end(), leaves.pieces[i].nodes.begin(), leaves.pieces[i].nodes.end());
        end_face(leaves.uncut.size() + i);
    }
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    const auto may_be_another = [&](Index v) { return v >= merged.size() || merged[v]; };
    for (Index e = 0; e < edges.size(); ++e) {
        const auto at = edges.corners_of(e);
        if (at.size() != 2 || mesh.corners[at[0]] == mesh.corners[at[1]]) continue;
        if (!may_be_another(edges.edges[e].low) || !may_be_another(edges.edges[e].high)) continue;
        const Index i = leaf_of_face[faces[at[0]]], j = leaf_of_face[faces[at[1]]];
        const Leaf a = leaves.leaf(i), b = leaves.leaf(j);
        if (a.turns == b.turns && a.of_inward == b.of_inward) sets.join(patch[i], patch[j]);
    }
}

/// The lowest leaf of the patch of each leaf. A patch has leaves connected by edges without other leaves.
/// They have the same winding numbers on their sides.
std::vector<Index> patches_of(const Leaves& leaves, const std::vector<std::uint8_t>& cut,
                              const Arrangement& arrangement) {
    const ClosedTriangles& c = leaves.c;
    std::vector<std::uint8_t> merged(c.mesh.vertex_count(), 0); // vertices that may have been merged
    for (Index f = 0; f < c.mesh.face_count(); ++f)
        for (Index k = c.mesh.face_begin(f); cut[f] && k < c.mesh.face_end(f); ++k)
            merged[c.mesh.vertex(k)] = 1;
    std::vector<Index> patch = join_uncut(leaves, cut, merged);
    DisjointSets sets(leaves.count());
    join_rest(leaves, arrangement, merged, patch, sets);
    parallel_for(patch.size(), [&](std::size_t i) { patch[i] = sets.find(patch[i]); });
    return patch;
}

/// The winding numbers in front of a leaf. Components outside the cluster count only if the cluster
/// contains a cavity.
Sides front_of(const ClosedTriangles& c, const Leaf& leaf, bool has_cavity, const Arrangement::Seen& seen) {
    Sides ahead;
    int around = 0;
    for (const auto& [t, turn] : seen.hits)
        if (c.cluster_of(t) != leaf.cluster)
            around += turn;
        else
            c.count(ahead, t, turn);
    if (seen.way < 0)
        for (std::size_t k = 0; k < 2; ++k) {
            ahead[k].outward -= leaf.turns[k].outward;
            ahead[k].inward -= leaf.turns[k].inward;
        }
    if (has_cavity && around > 0) ++ahead[0].outward;
    return ahead;
}

/// The lower winding number of the outward components on both sides.
int least_around(const Operands* operands, const Sides& front, const Sides& back, std::size_t operand) {
    const bool reversed = operand == 1 && operands->operation == CombineOperation::subtract;
    const int sign = reversed ? -1 : 1;
    return std::min(sign * front[operand].outward, sign * back[operand].outward);
}

/// True if the centre of a leaf is certainly in a region from which all faces are removed.
bool is_buried(const Leaf& l, const Buried& buried, const Arrangement& arrangement) {
    if (!buried.takes_all()) return false;
    std::array<Vec3, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = arrangement.position(l.nodes[k]);
    const Vec3 centre = (at[0] + at[1] + at[2]) / 3;
    const double largest = std::max({length(at[0]), length(at[1]), length(at[2])});
    return buried.holds_point({centre, 0x1p-49 * largest}, l.cluster);
}

void refuse(United& result, Index cluster, const std::string& why) {
    for (const auto& r : result.refused)
        if (r.cluster == cluster) return;
    result.refused.push_back({cluster, why});
}

std::vector<Fate> judge_patches(const Leaves& leaves, const std::vector<Index>& patch, const Buried& buried,
                                const Arrangement& arrangement, bool rounds, United& result) {
    const ClosedTriangles& c = leaves.c;
    std::vector<std::uint8_t> has_cavity(c.solids.clusters(), 0); // an inward component
    for (Index p = 0; p < c.solids.components.count; ++p)
        if (c.solids.cluster[p] != none && c.solids.inward[p]) has_cavity[c.solids.cluster[p]] = 1;
    std::vector<Index> firsts; // the lowest leaf of each patch
    std::vector<Arrangement::Look> looks;
    for (Index i = 0; i < leaves.count(); ++i) {
        if (patch[i] != i || is_buried(leaves.leaf(i), buried, arrangement)) continue;
        firsts.push_back(i);
        looks.push_back({leaves.leaf(i).nodes, leaves.sources_of(arrangement, i)});
    }
    const auto seen = arrangement.look_ahead(looks);
    std::vector<Fate> fate(leaves.count(), Fate::goes);
    for (std::size_t n = 0; n < firsts.size(); ++n) {
        const Leaf first = leaves.leaf(firsts[n]);
        const Sides front = front_of(c, first, has_cavity[first.cluster] != 0, seen[n]),
                    back = sum(front, first.turns);
        for (std::size_t k = 0; k < 2; ++k)
            if (first.of_inward[k] && least_around(c.operands, front, back, k) < 1)
                refuse(result, first.cluster, rounds ? turned_by_rounding : inside_out);
        const bool before = encloses(front, c.operands), behind = encloses(back, c.operands);
        if (before != behind) fate[firsts[n]] = behind ? Fate::stays : Fate::stays_turned;
    }
    parallel_for(leaves.count(), [&](std::size_t i) {
        if (patch[i] != i) fate[i] = fate[patch[i]];
    });
    return fate;
}

/// [components] 1 for uncut cavities that another solid of a cluster fills; they are removed.
std::vector<std::uint8_t> filled_cavities(const ClosedTriangles& c, const Arrangement& arrangement) {
    std::vector<std::uint8_t> filled(c.solids.components.count, 0);
    std::vector<std::uint8_t> asked(c.solids.components.count, 0);
    bool any = false;
    for (Index p = 0; p < asked.size(); ++p) any |= c.solids.cluster[p] == none && c.solids.inward[p];
    if (!any) return filled;
    std::vector<Arrangement::Look> looks;
    for (Index t = 0; t < c.triangles.face.size(); ++t) {
        const Index p = c.component_of(t);
        if (asked[p] || c.solids.cluster[p] != none || !c.solids.inward[p] || !c.has_area(t)) continue;
        asked[p] = 1;
        looks.push_back({c.nodes_of(t), {t}});
    }
    const auto seen = arrangement.look_ahead(looks);
    for (std::size_t i = 0; i < looks.size(); ++i) {
        std::vector<int> winding(c.solids.clusters(), 0);
        for (const auto& [hit, turn] : seen[i].hits)
            if (c.cluster_of(hit) != none) winding[c.cluster_of(hit)] += turn;
        for (const int w : winding) filled[c.component_of(looks[i].but[0])] |= w >= 2;
    }
    return filled;
}

OuterPiece piece_of(const std::array<Index, 3>& nodes, Index triangle) {
    return {nodes, {triangle, triangle, triangle}};
}

std::vector<std::uint8_t> settled(const ClosedTriangles& c, const std::vector<std::uint8_t>& goes,
                                  const UnitedMesh& united) {
    if (c.solids.rings.empty()) return {};
    Rings whole = c.solids.rings;
    for (Index f = 0; f < goes.size(); ++f)
        for (Index k = c.mesh.face_begin(f); goes[f] && k < c.mesh.face_end(f); ++k)
            whole[c.mesh.vertex(k)] = 0;
    std::vector<std::uint8_t> settled(united.mesh.vertex_count(), 0);
    parallel_for(united.old_vertices.size(),
                 [&](std::size_t v) { settled[v] = whole[united.old_vertices[v]]; });
    return settled;
}

void assemble(const Leaves& leaves, const std::vector<std::uint8_t>& cut, const std::vector<Fate>& fate,
              const Arrangement& arrangement, const SnapTolerance& rounding, United& result) {
    const ClosedTriangles& c = leaves.c;
    const std::vector<std::uint8_t> filled = filled_cavities(c, arrangement);
    std::vector<std::uint8_t> goes = cut;
    const bool any_filled = std::find(filled.begin(), filled.end(), 1) != filled.end();
    for (Index f = 0; any_filled && f < goes.size(); ++f)
        if (filled[c.solids.components.of_face[f]]) {
            goes[f] = 1;
            ++result.covered_faces;
        }
    std::vector<OuterPiece> pieces;
    const auto covered = indices_where(leaves.uncut.size(), [&](Index i) { return fate[i] == Fate::goes; });
    for (const Index i : covered) goes[leaves.uncut[i]] = 1;
    result.covered_faces += covered.size();
    for (std::size_t i = 0; i < leaves.pieces.size(); ++i) {
        const Leaf& leaf = leaves.pieces[i];
        const Fate end = fate[leaves.uncut.size() + i];
        const auto& [i0, i1, i2] = leaf.nodes;
        if (end == Fate::stays) pieces.push_back(piece_of(leaf.nodes, leaf.first));
        if (end == Fate::stays_turned) pieces.push_back(piece_of({i0, i2, i1}, leaf.against));
    }
    result.cut_faces = static_cast<std::size_t>(std::count(cut.begin(), cut.end(), 1));
    const auto uncut = faces_without(goes);
    result.uncut_faces = uncut.size();
    pieces = redrawn(c.mesh, uncut, std::move(pieces), arrangement, c.triangles);
    UnitedMesh united = united_mesh(c.mesh, uncut, pieces, arrangement, c.triangles, rounding);
    result.settled = settled(c, goes, united);
    result.mesh = std::move(united.mesh);
    result.changes = std::move(united.changes);
}

std::string lack_of_memory(std::size_t pairs) {
    return fmt::format("there is not enough memory to cut {} pairs of intersecting triangles along each "
                       "other",
                       pairs);
}

bool refuse_for_memory(TriangleSoup& soup, const PassBudget& effort, std::size_t clusters, United& result) {
    constexpr double bytes_a_pair = 1700, bytes_a_triangle = 100,
                     bytes_a_crossing = 100; // measured memory
    double left = effort.memory ? static_cast<double>(*effort.memory) : HUGE_VAL;
    left -= bytes_a_pair * static_cast<double>(soup.pairs.size()) +
            bytes_a_triangle * static_cast<double>(soup.triangles.size());
    if (left > 0) {
        soup.max_pairs = effort.pairs;
        soup.max_crossings =
            std::min(effort.crossings, static_cast<std::size_t>(std::min(left / bytes_a_crossing, 1e18)));
        return false;
    }
    for (Index c = 0; c < clusters; ++c) refuse(result, c, lack_of_memory(soup.pairs.size()));
    result.short_of_memory = true;
    return true;
}

} // namespace

United unite(Mesh& mesh, const Solids& solids, const SelfIntersections& found, const SnapTolerance& rounding,
             const Operands* operands, const PassBudget& effort) {
    United result;
    ClosedTriangles c{mesh, solids, operands};
    gather(c);
    const Buried buried(mesh, solids, found, c.triangles, c.first, operands);
    const FacesToCut cuts = faces_to_cut(c, found, buried);
    merge_where_cut(c, cuts.cut);
    TriangleSoup soup = triangle_soup(c, cuts);
    result.pairs = soup.pairs.size();
    if (refuse_for_memory(soup, effort, solids.clusters(), result)) return result;
    const bool is_short = soup.max_crossings < effort.crossings && soup.pairs.size() <= soup.max_pairs;
    const Arrangement arrangement(std::move(soup));
    if (const auto full = arrangement.overfull()) {
        result.short_of_memory = is_short;
        refuse(result, c.cluster_of(*full), is_short ? lack_of_memory(result.pairs) : effort.too_many);
        return result;
    }
    const Leaves leaves = leaves_of(c, cuts.cut, arrangement);
    const std::vector<Index> patch = patches_of(leaves, cuts.cut, arrangement);
    const std::vector<Fate> fate =
        judge_patches(leaves, patch, buried, arrangement, rounding.tolerance > 0, result);
    if (result.refused.empty()) assemble(leaves, cuts.cut, fate, arrangement, rounding, result);
    return result;
}

} // namespace facetmill::clean_steps
