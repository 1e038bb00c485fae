#pragma once
// Finds faces of a mesh that intersect each other.

#include "geometry/intersect/plain_stars.hpp"
#include "mesh/mesh.hpp"
#include "mesh/surface.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace facetmill {

struct SelfIntersectionSettings {
    std::size_t limit = 10;               ///< maximum number of listed pairs; all are counted
    std::vector<std::uint8_t> among = {}; ///< [faces] only pairs with a flagged face; empty: all pairs
    /// [vertices] The result of plain_stars. Computed if empty and all pairs are requested.
    std::vector<Star> stars = {};
    bool separate_touching = false; ///< pairs that only touch are counted and listed separately
    /// If more pairs of triangles have boxes that meet, the search does not start. The pairs are counted
    /// first.
    std::size_t max_box_pairs = std::size_t(-1);
};

struct SelfIntersections {
    std::size_t count = 0;                      ///< number of pairs of faces
    std::vector<std::pair<Index, Index>> pairs; ///< the first pairs by (lower, higher face), up to the limit
    std::size_t touching =
        0; ///< with `separate_touching`: pairs that only touch, which `count` and `pairs` leave out
    std::vector<std::pair<Index, Index>> touching_pairs; ///< the first of these pairs, up to the limit
    /// Pairs of triangles whose boxes meet. They measure the work and are the same for any number of threads.
    std::size_t box_pairs = 0;
    bool too_many =
        false; ///< box_pairs exceeds the limit and was counted only to one more; all else is empty
};

/// Finds the pairs of faces that meet elsewhere than in the vertices and edges they share, decided exactly
/// (CGAL's exact predicates) on the unchanged positions. Sharing is by vertex index, so faces that touch at
/// equal positions of different vertices count. On request, pairs that only touch
/// (geometry/intersect/contacts.hpp) are distinguished. Neighbours folded over each other in the same plane
/// count. Faces without area (see Properties::degenerate_faces), or with coordinates that are not finite,
/// are ignored. Polygons are represented by their triangles (mesh/triangulated), which are not compared with
/// each other. Walks a tree of boxes against itself: O(n log n) plus the number of pairs. Parallel; the
/// result does not depend on the number of threads.
[[nodiscard]] SelfIntersections find_self_intersections(const Mesh& mesh,
                                                        const SelfIntersectionSettings& settings = {});
/// The same, for triangles that represent this many faces.
[[nodiscard]] SelfIntersections find_self_intersections(Surface surface, std::size_t faces,
                                                        const SelfIntersectionSettings& settings);

struct MeetingFaces {
    bool too_many = false;           ///< box_pairs exceeds the limit, so `faces` is empty
    std::vector<std::uint8_t> faces; ///< [faces] 1 for faces that meet another face
    std::size_t box_pairs = 0;       ///< see SelfIntersections::box_pairs
};

/// Searches repeatedly for pairs of faces of a mesh while its vertices move. The tree is sorted once; the
/// cost of each later search depends on the moved faces and their surroundings.
class SelfIntersectionSearch {
  public:
    /// frame: the frame of another search, so that both round boxes alike and find the same pairs of boxes.
    explicit SelfIntersectionSearch(const Mesh& mesh, const Box& frame = {});
    /// Searches the triangles of this many faces, which do not move.
    SelfIntersectionSearch(Surface surface, std::size_t faces);
    SelfIntersectionSearch(SelfIntersectionSearch&&) noexcept;
    SelfIntersectionSearch& operator=(SelfIntersectionSearch&&) noexcept;
    ~SelfIntersectionSearch();

    /// Updates the search after vertices of the mesh, otherwise unchanged, have moved. moved: flags of the
    /// faces with moved vertices; empty if any may have.
    void move_to(const Mesh& mesh, const std::vector<std::uint8_t>& moved);

    /// The box of all positions so far, including the frame given by another search.
    const Box& frame() const;

    /// Like find_self_intersections.
    SelfIntersections pairs(const SelfIntersectionSettings& settings);

    /// The faces of these pairs, without the exempt pairs (lower face first, ascending). This is much faster
    /// than `pairs` if a face is in many pairs, because pairs of two faces that are already known are
    /// skipped. The result for a face does not depend on the threads, but the pair that decides it may. Ends
    /// after more than max_box_pairs tests.
    MeetingFaces faces(const std::vector<std::uint8_t>& among,
                       std::span<const std::pair<Index, Index>> exempt,
                       std::size_t max_box_pairs = std::size_t(-1));

  private:
    class Search;
    std::unique_ptr<Search> search_;
};

} // namespace facetmill
