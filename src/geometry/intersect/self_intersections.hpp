#pragma once
// Which faces of a mesh run into each other.

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
    std::size_t limit = 10;               ///< how many pairs are listed; all are counted
    std::vector<std::uint8_t> among = {}; ///< [faces] only pairs with a face that is set; empty: all pairs
    /// [vertices] of plain_stars; if empty and all pairs are requested, they are computed.
    std::vector<Star> stars = {};
    bool separate_touching = false; ///< pairs that only touch are counted and listed separately
    /// If the boxes of more pairs of triangles meet, the search does not start. They are counted first.
    std::size_t max_box_pairs = std::size_t(-1);
};

struct SelfIntersections {
    std::size_t count = 0; ///< pairs of faces
    std::vector<std::pair<Index, Index>>
        pairs; ///< the first by (lower, higher face), as many as the limit allows
    std::size_t touching =
        0; ///< with `separate_touching`: pairs that only touch, which `count` and `pairs` leave out
    std::vector<std::pair<Index, Index>> touching_pairs; ///< the first of them, likewise
    /// Pairs of triangles whose boxes meet. They measure the work and are the same for any number of threads.
    std::size_t box_pairs = 0;
    bool too_many = false; ///< box_pairs, which were counted up to one more than the limit: the rest is empty
};

/// Finds the pairs of faces that meet elsewhere than in the vertices and edges they share, decided exactly
/// (CGAL's exact predicates) on the positions as they are. Sharing is by vertex index: faces that touch at
/// equal positions of different vertices do meet elsewhere; on request pairs that only touch there
/// (geometry/intersect/contacts.hpp) are distinguished. Neighbours that fold over each other in one plane
/// count. Faces without area take no part (Properties::degenerate_faces counts them), nor do those with
/// coordinates that are not finite. Polygons stand for their triangles (mesh/triangulated), which do not
/// count among themselves. A tree of boxes is walked against itself: O(n log n) and the pairs there
/// are. Parallel; the same for any number of threads.
[[nodiscard]] SelfIntersections find_self_intersections(const Mesh& mesh,
                                                        const SelfIntersectionSettings& settings = {});
/// The same, of triangles that stand for so many faces.
[[nodiscard]] SelfIntersections find_self_intersections(Surface surface, std::size_t faces,
                                                        const SelfIntersectionSettings& settings);

struct MeetingFaces {
    bool too_many = false;           ///< box pairs: the faces are left out
    std::vector<std::uint8_t> faces; ///< [faces] 1 for faces that meet another
    std::size_t box_pairs = 0;       ///< as above
};

/// Searches repeatedly for pairs of faces of a mesh while its vertices move. The tree is sorted once; each
/// later search depends on the moved faces and their surroundings.
class SelfIntersectionSearch {
  public:
    /// frame: of another search, whose boxes were rounded in it, so that as many pairs of boxes meet here.
    explicit SelfIntersectionSearch(const Mesh& mesh, const Box& frame = {});
    /// For the triangles of so many faces, which do not move.
    SelfIntersectionSearch(Surface surface, std::size_t faces);
    SelfIntersectionSearch(SelfIntersectionSearch&&) noexcept;
    SelfIntersectionSearch& operator=(SelfIntersectionSearch&&) noexcept;
    ~SelfIntersectionSearch();

    /// Updates the search after vertices of the mesh, otherwise unchanged, have moved. moved: flags of the
    /// faces with moved vertices; empty if any may have.
    void move_to(const Mesh& mesh, const std::vector<std::uint8_t>& moved);

    /// Contains all positions so far, including the frame given by another search.
    const Box& frame() const;

    /// As find_self_intersections.
    SelfIntersections pairs(const SelfIntersectionSettings& settings);

    /// The faces of those pairs, without the exempt pairs (lower face first, ascending). This is much faster
    /// than `pairs` if a face is in many pairs, because a pair of two known faces is skipped. The result for
    /// a face does not depend on the threads, but the pair that decides it may. Ends after more than
    /// max_box_pairs tests.
    MeetingFaces faces(const std::vector<std::uint8_t>& among,
                       std::span<const std::pair<Index, Index>> exempt,
                       std::size_t max_box_pairs = std::size_t(-1));

  private:
    class Search;
    std::unique_ptr<Search> search_;
};

} // namespace facetmill
