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
    /// [vertices] of plain_stars; where none are given and all pairs are asked for, they are found.
    std::vector<Star> stars = {};
    bool separate_touching = false; ///< pairs that only touch are counted and listed separately
    /// When the boxes of more pairs of triangles meet, nothing is looked at. They are counted first.
    std::size_t max_box_pairs = std::size_t(-1);
};

struct SelfIntersections {
    std::size_t count = 0; ///< pairs of faces
    std::vector<std::pair<Index, Index>>
        pairs; ///< the first by (lower, higher face), as many as the limit allows
    std::size_t touching =
        0; ///< with `separate_touching`: pairs that only touch, which `count` and `pairs` leave out
    std::vector<std::pair<Index, Index>> touching_pairs; ///< the first of them, likewise
    /// Pairs of triangles whose boxes meet: what the work is, the same for any number of threads.
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
SelfIntersections find_self_intersections(const Mesh& mesh, const SelfIntersectionSettings& settings = {});
/// The same, of triangles that stand for so many faces.
SelfIntersections find_self_intersections(Surface surface, std::size_t faces,
                                          const SelfIntersectionSettings& settings);

struct MeetingFaces {
    bool too_many = false;           ///< box pairs: what faces were found is left out
    std::vector<std::uint8_t> faces; ///< [faces] 1 for those that meet another
    std::size_t box_pairs = 0;       ///< as above
};

/// Looks for pairs of faces of a mesh again and again, while its vertices move. The tree is sorted once; what
/// a look takes after that is for the faces that have moved and for those around them.
class SelfIntersectionSearch {
  public:
    /// frame: of another search, whose boxes were rounded in it, so that as many pairs of boxes meet here.
    explicit SelfIntersectionSearch(const Mesh& mesh, const Box& frame = {});
    /// Of triangles that stand for so many faces, which do not move.
    SelfIntersectionSearch(Surface surface, std::size_t faces);
    SelfIntersectionSearch(SelfIntersectionSearch&&) noexcept;
    SelfIntersectionSearch& operator=(SelfIntersectionSearch&&) noexcept;
    ~SelfIntersectionSearch();

    /// The vertices of the mesh, which is the same else, have moved: those of the faces that are flagged, or
    /// where none are given, of any.
    void move_to(const Mesh& mesh, const std::vector<std::uint8_t>& moved);

    /// Holds all that there has been, and what another search was given.
    const Box& frame() const;

    /// As find_self_intersections.
    SelfIntersections pairs(const SelfIntersectionSettings& settings);

    /// The faces of those pairs, the exempt pairs (lower face first, ascending)
    /// left out. Where a face is in many pairs this is much faster: a pair of faces that are known both is
    /// not looked at. Which pair tells of a face depends on the threads, whether one does, does not. Ends
    /// when more than max_box_pairs were looked at.
    MeetingFaces faces(const std::vector<std::uint8_t>& among,
                       std::span<const std::pair<Index, Index>> exempt,
                       std::size_t max_box_pairs = std::size_t(-1));

  private:
    class Search;
    std::unique_ptr<Search> search_;
};

} // namespace facetmill
