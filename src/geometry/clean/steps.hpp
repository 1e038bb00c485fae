#pragma once
// The steps of clean. Each function changes the mesh in place, adds to the counts, and returns true if it
// changed anything.

#include "geometry/boolean/loose_edges.hpp"
#include "geometry/clean/clean.hpp"
#include "geometry/edit/split_non_manifold.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/intersect/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace facetmill::clean_steps {

/// The mesh being cleaned, and the reports about it.
struct Work {
    Mesh mesh;
    CleanCounts counts;
    std::vector<NotDone> not_done;
    AttributeChanges changes; ///< changes by the last step that mixed attributes
    bool untangled = false;   ///< the mesh is known to have no intersections
    /// The reports about intersections that could not be repaired; valid until the mesh changes.
    std::optional<std::vector<NotDone>> tangled = {};
    UntangleBudget budget = {};
    std::set<std::array<double, 3>> stuck = {}; ///< positions where vertices could not be moved apart
    bool short_of_memory = false;               ///< a repair was skipped because of insufficient memory
    bool cloud = false;                         ///< the input had no faces, so its vertices are kept

    /// True if this many intersecting pairs of faces may be processed.
    bool may_process(std::size_t pairs) const {
        return pairs <= mesh.face_count() || pairs <= budget.vain_pairs;
    }
    void processed_in_vain(std::size_t pairs) { budget.vain_pairs -= std::min(pairs, budget.vain_pairs); }
    /// The number of pairs of boxes that may be examined.
    std::size_t max_box_pairs() const { return 32 * mesh.face_count() + budget.box_pairs; }
};

/// Rounds positions to 32-bit floats, if the results are finite.
bool round_to_single(Work& work);
/// Merges vertices at the same position into the lowest. comes_apart: non_manifold is on (see
/// split_non_manifold). Then vertices stay unmerged if their faces would be separated again.
bool weld_equal(Work& work, bool comes_apart);
/// In index order, merges each end of a boundary edge into the nearest kept end within tolerance. Vertices of
/// the same face are never merged, so that no face loses its area. Inner vertices stay unchanged.
bool weld_near(Work& work, double tolerance);
/// Merges boundary edges with opposite directions whose ends are within tolerance, the nearest pairs first.
/// Their ends merge into the lower vertices.
bool stitch(Work& work, double tolerance);
/// Removes corners that repeat the vertex before them, then faces without area (exact). If removal would
/// open the surface, inserts their vertices into the opposite edges, so that a closed surface stays closed.
bool remove_degenerate(Work& work);
/// Keeps one face of each set with the same vertices, in the majority's orientation. It keeps as many as are
/// left after cancelling if the surrounding faces occur equally often, so that a closed surface stays
/// closed. Cancelling faces (equal numbers in both orientations) are all removed if they form a wall or fin
/// on other faces. In a closed surface, a common vertex is enough. If they form a separate sheet, one of
/// each stays.
bool remove_duplicates(Work& work, bool walls);
/// Inserts a vertex into a boundary edge of another face if it is on that edge (near: within tolerance). The
/// vertex must have a boundary edge along it.
bool resolve_t_junctions(Work& work, double tolerance);
/// See part_fans and divide_crowded_edges. If an edge's midpoint cannot be exactly on it, and faces would
/// intersect or lose their area, the edge stays and is reported. `left`: receives the edges of the resulting
/// mesh, if known.
bool take_apart_non_manifold(Work& work, const EdgeDivision& how, std::optional<EdgeTable>* left = nullptr);
/// Edges as (low vertex, high vertex), ascending.
using EdgeList = std::vector<std::pair<Index, Index>>;
/// Fills the loops of boundary edges according to the settings; holes that touch at a vertex are filled
/// separately. Loops with an edge of other_than stay open, as do loops whose patch would intersect faces
/// (unless may_cross), or cover adjacent faces within 32-bit rounding. The border of a flat sheet is not a
/// hole.
bool fill_holes(Work& work, const HoleSettings& settings, const EdgeList* other_than, bool may_cross);
/// Removes components with boundary edges, if a closed component is left.
bool remove_open_components(Work& work);
bool remove_components(Work& work, const ComponentSettings& settings);
/// Removes closed components that are inside other closed components and touch none.
bool remove_inner_components(Work& work);
bool remove_isolated(Work& work);
/// Moves vertices of faces that share a position apart; one of them stays. It uses the smallest movement for
/// which, exactly, no face is reversed or loses its area, and no new pair of faces intersects or touches.
/// The movement is 2, 4 ... 256 float32 steps (of the farthest coordinate) along each axis, and at most an
/// eighth of the shortest edge. Vertices without such a movement stay and are reported.
///
/// Requires 32-bit positions. After weld_equal and take_apart_non_manifold, vertices that still coincide
/// belong to separate fans. O(n log n), plus the cost of the faces around each vertex, limited by
/// budget.apart.
bool move_apart(Work& work);
/// The pairs of intersecting faces, for the two steps below. Vertices at the same position count as equal, so
/// faces separated only by a split edge or vertex (split_non_manifold) do not intersect. Lists at most
/// max_pairs, and none if more than max_box_pairs must be examined.
[[nodiscard]] SelfIntersections crossings(const Mesh& mesh, std::vector<std::uint8_t> among = {},
                                          std::size_t max_box_pairs = std::size_t(-1));
/// place: result of lowest_at_place. True if all positions are distinct.
bool are_distinct(const std::vector<Index>& place);
struct CrossingsAndRings {
    SelfIntersections found;
    Rings rings; ///< rings of a triangle mesh, unless positions coincide
};
/// Up to `limit` pairs, without pairs that contain a lost face (lost_faces). place: result of
/// lowest_at_place.
[[nodiscard]] CrossingsAndRings crossings_and_rings(const Mesh& mesh, const std::vector<Index>& place,
                                                    std::size_t limit, const std::vector<std::uint8_t>& lost);
/// The same for a few flagged faces of a large mesh: examines only their surroundings.
[[nodiscard]] SelfIntersections crossings_near(const Mesh& mesh, const std::vector<std::uint8_t>& flags,
                                               std::size_t max_box_pairs = std::size_t(-1));
/// A mesh of the listed faces in that order, with the vertices that they use; no attributes.
[[nodiscard]] Mesh only_faces(const Mesh& mesh, const std::vector<Index>& faces);
inline constexpr std::size_t max_pairs = std::size_t{1} << 22;
/// Pairs of faces, lower first, ascending, that connect all faces at edges around which the surface winds
/// more than once. Solids overlap at such edges without intersecting, for example grids that cross along
/// their lines.
[[nodiscard]] std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh);
/// The same; faster, given the rings and edges of the mesh.
[[nodiscard]] std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh, const Rings& rings,
                                                                     const LooseEdges& edges);
/// Replaces closed components that intersect each other or themselves by their union, by winding numbers (see
/// unite). `found`: the intersections of the mesh; `overlaps`: the overlaps at edges. Closed surfaces stay
/// closed. Intersections with components that are not closed stay. These, and solids that cannot be united,
/// are reported and left unchanged. Faces without intersections and outside all other components are
/// unchanged too.
bool unite_solids(Work& work, SelfIntersections found, const std::vector<std::pair<Index, Index>>& overlaps,
                  const CleanSettings& settings);
/// Repairs each intersection separately: removes the intersecting faces, if necessary with up to four rings
/// around them, and fills the hole. An intersection stays unchanged if its repair would leave an
/// intersection or a new boundary edge, or change the topology. It also stays if the repair would remove
/// half of a component or exceed the budget. Faces that touch only at vertices with the same position do not
/// count.
bool resolve_self_intersections(Work& work, SelfIntersections found);

} // namespace facetmill::clean_steps
