#pragma once
// The steps of clean, one function each. Each changes the mesh in place, adds to the counts and tells by its
// return value whether it changed anything.

#include "geometry/boolean/loose_edges.hpp"
#include "geometry/clean/clean.hpp"
#include "geometry/edit/split_non_manifold.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/intersect/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace facetmill::clean_steps {

/// The mesh being cleaned and what is told of it.
struct Work {
    Mesh mesh;
    CleanCounts counts;
    std::vector<NotDone> not_done;
    AttributeChanges changes; ///< of the step that mixed attributes last
    bool untangled = false;   ///< the mesh is known to have no crossings
    /// What was told of the crossings when nothing could be done about them; while nothing changes, it holds.
    std::optional<std::vector<NotDone>> tangled = {};
    UntangleBudget budget = {};
    std::set<std::array<double, 3>> stuck = {}; ///< where vertices could not be moved apart
    bool short_of_memory = false;               ///< something was not tried for want of memory
    bool cloud = false; ///< there was no face to begin with: the vertices are what it has

    /// Whether so many intersecting pairs of faces may be processed.
    bool may_process(std::size_t pairs) const {
        return pairs <= mesh.face_count() || pairs <= budget.vain_pairs;
    }
    void processed_in_vain(std::size_t pairs) { budget.vain_pairs -= std::min(pairs, budget.vain_pairs); }
    /// How many pairs of boxes may be looked at.
    std::size_t max_box_pairs() const { return 32 * mesh.face_count() + budget.box_pairs; }
};

/// Positions become the nearest ones of 32-bit floats, as far as those are finite.
bool round_to_single(Work& work);
/// Vertices at one place become the lowest of them. Where the faces that meet there would only come apart
/// again (non_manifold, see split_non_manifold), they are left as they are.
bool weld_equal(Work& work, bool comes_apart);
/// In index order each end of a boundary edge becomes the nearest one kept so far within tolerance. Vertices
/// of one face are never merged, so that no face loses its area; vertices inside the surface are left alone.
bool weld_near(Work& work, double tolerance);
/// Boundary edges that run against each other and whose ends are within tolerance become one, the nearest
/// pairs first; their ends become the lower vertices.
bool stitch(Work& work, double tolerance);
/// Corners that repeat the vertex before them go, then faces without area (exact). Where that opens the
/// surface, the vertices on the line are put on the edges that face it, so that what was closed stays closed.
bool remove_degenerate(Work& work);
/// Of faces with the same vertices one stays, with the orientation that they have more often; as many as are
/// left after cancelling where the faces around are there as often, so that what was closed stays closed.
/// Faces that cancel (as often one way as the other) all go when they are a wall or a fin on other faces (of
/// a closed surface also when they touch it with a corner), and one of each stays when they are a sheet of
/// their own.
bool remove_duplicates(Work& work);
/// A vertex on (near: within tolerance of) a boundary edge of another face, with a boundary edge of its own
/// along that one, is put on it.
bool resolve_t_junctions(Work& work, double tolerance);
/// See part_fans and divide_crowded_edges. An edge whose middle cannot be put exactly on it stays as it is
/// where faces would intersect others for that, or lose their area, and is told. `left` becomes the edges of
/// the mesh afterwards, where they are known.
bool take_apart_non_manifold(Work& work, const EdgeDivision& how, std::optional<EdgeTable>* left = nullptr);
/// Edges as (low vertex, high vertex), ascending.
using EdgeList = std::vector<std::pair<Index, Index>>;
/// Fills the loops of boundary edges as the settings say; holes that touch at a vertex each for itself. Loops
/// with an edge of other_than stay, and so do those whose patch would run into other faces, unless it may,
/// or lie on the faces beside it (but for the rounding of 32 bits): where a flat sheet ends is no hole.
bool fill_holes(Work& work, const HoleSettings& settings, const EdgeList* other_than, bool may_cross);
/// Components with boundary edges go; none, unless a closed one is left.
bool remove_open_components(Work& work);
bool remove_components(Work& work, const ComponentSettings& settings);
/// Closed components that lie inside other closed components and touch none go.
bool remove_inner_components(Work& work);
bool remove_isolated(Work& work);
/// Vertices at one place, of faces: all but one of them are moved away by the fewest steps of float32 (of the
/// size that they have at the mesh's farthest coordinate; 2, 4 ... 256 along each axis, and an eighth of its
/// shortest edge at most) for which, exactly, no face turns over or loses its area, and none intersects or
/// touches another that it did not before. Those that no such move exists for stay and are told. Positions
/// are those of 32-bit floats, and after weld_equal and take_apart_non_manifold vertices at one place are
/// ones that belong apart. O(n log n), and for each of them what the faces around cost, within budget.apart
/// in all.
bool move_apart(Work& work);
/// The pairs of faces that intersect, for the two steps below; vertices at one place count as one, so that
/// faces which are separated only by an edge or vertex that was split (split_non_manifold) are none. At most
/// max_pairs are listed; none when more than max_box_pairs would have to be looked at.
SelfIntersections crossings(const Mesh& mesh, std::vector<std::uint8_t> among = {},
                            std::size_t max_box_pairs = std::size_t(-1));
/// place: of lowest_at_place. Whether no two vertices are at one place.
bool are_distinct(const std::vector<Index>& place);
struct CrossingsAndRings {
    SelfIntersections found;
    Rings rings; ///< of a mesh of triangles, unless vertices are at one place
};
/// As many of them as are asked for, but for pairs with a face that is flagged as lost (lost_faces). place:
/// of lowest_at_place.
CrossingsAndRings crossings_and_rings(const Mesh& mesh, const std::vector<Index>& place, std::size_t limit,
                                      const std::vector<std::uint8_t>& lost);
/// The same pairs of faces that are flagged, for a few of many faces: only what is near them is looked at.
SelfIntersections crossings_near(const Mesh& mesh, const std::vector<std::uint8_t>& flags,
                                 std::size_t max_box_pairs = std::size_t(-1));
/// The bare mesh of some of the faces, in that order, with the vertices that they use.
Mesh only_faces(const Mesh& mesh, const std::vector<Index>& faces);
inline constexpr std::size_t max_pairs = std::size_t{1} << 22;
/// Pairs of faces, lower one first, ascending, that link all faces at edges around which the surface winds
/// more than once: there solids overlap without any crossing, as grids do that pass through each other along
/// their lines.
std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh);
/// Likewise; faster, given the rings and edges of the mesh.
std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh, const Rings& rings,
                                                       const LooseEdges& edges);
/// Closed components that pass through each other, or through themselves, become one solid: the union, by
/// winding numbers (see unite). `found` are the crossings of the mesh, `overlaps` those at edges. What is
/// closed stays closed; what intersects does not any more, but with components that are not closed: those,
/// and solids that cannot be united, are told and left exactly as they were. Faces that intersect nothing and
/// lie outside of all other components are left alone.
bool unite_solids(Work& work, SelfIntersections found, const std::vector<std::pair<Index, Index>>& overlaps,
                  const CleanSettings& settings);
/// Place by place: removes the faces that intersect others, if need be with up to four rings around them, and
/// fills what that opens. A place is left as it was when that would leave an intersection or a boundary edge
/// that was not there, change the topology, take half of a component along, or use up the budget. Faces that
/// touch only where vertices of theirs are at one place do not count.
bool resolve_self_intersections(Work& work, SelfIntersections found);

} // namespace facetmill::clean_steps
