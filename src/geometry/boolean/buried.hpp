#pragma once
// Finds intersections so deep inside a union that they need not be cut.

#include "geometry/boolean/boolean_pass.hpp"
#include "geometry/spatial/box_tree.hpp"

#include <optional>
#include <span>

namespace facetmill::clean_steps {

/// A point with a known floating-point error: each coordinate is within `off` of the true coordinate.
struct NearPoint {
    Vec3 at;
    double off = 0;
};

/// Open sets around which closed components certainly wind, and the faces inside them.
///
/// The *core* of a closed component is the set of points strictly behind all its triangles' planes. A ray
/// from such a point crosses each triangle that it meets from back to front, and a ray towards a triangle
/// meets at least one. So the winding number is at least 1 at each core point. The core is convex, as an
/// intersection of half-spaces. It is the interior of a convex solid, but empty for most other solids.
///
/// Let K be the union of the cores of certain components. These are all of a union, the subtracted components
/// of a difference, or the second operand of an intersection. A core is excluded if its box meets the box of
/// a component that may have a negative winding number. (A difference or an intersection counts only the
/// second operand.) That may be any component that neither has a core nor is manifold, outward and known to
/// be free of self-intersections. So inside K, a union has a winding number of at least 1, and a difference
/// removes everything: the result has no face in K.
///
/// **Faces that meet only in K need not be cut along each other.** Suppose that all other pairs are cut. A
/// leaf is a piece or an uncut face.
///
/// 1. Around a point outside K, all faces that meet are cut, as if no pair had been skipped.
/// 2. A leaf with a point in K is removed. K is open, so an interior point of the leaf is in K, and is
///    removed. If the leaf left K, it would have a point on the border of K. All faces around that point are
///    cut, so the sides of the leaf match those in K. By 1, nothing changes along the leaf outside K.
/// 3. Any other leaf has constant winding numbers on its sides, and all its edges have complete neighbours
///    with the same nodes. So one test point per leaf suffices, and so does joining leaves across edges. If
///    the neighbour has a point in K, both leaves are removed, because their sides match at the edge.
/// 4. A leaf with a point in K is found to be removed. An edge with a point in K joins it only to leaves that
///    are removed. If its centre is tested, uncut triangles may contain the centre. The ray skips these, so
///    it counts each component's winding number next to the centre. No number is negative, and a core that
///    contains the centre adds at least 1.
///
/// So each leaf has the same fate as if all pairs had been cut. Coincident faces do not bury each other,
/// because a core does not contain its border. A face whose pairs are all skipped has a point in K.
///
/// For an intersection, only pairs of two faces of the second operand are skipped. Let W be the operands'
/// winding numbers. If a leaf has a point in K, the second W is at least 1 along both sides, as in 2. A leaf
/// of the second operand alone has the same first W on both sides, so it is removed. For any other leaf the
/// first W decides. It is constant along the joined leaves, because faces of the first operand are cut along
/// all others.
///
/// The tests use doubles with error bounds; uncertain cases count as not buried. Solids smaller than 1e-60 or
/// beyond 1e100 bury nothing, so that no product under- or overflows.
class Buried {
  public:
    /// mesh: a subtracted second operand is reversed. triangles: the triangles of closed components; face f
    /// has those from first[f] to first[f + 1]. found: all pairs of intersecting faces.
    Buried(const Mesh& mesh, const Solids& solids, const SelfIntersections& found,
           const TriangleFaces& triangles, const std::vector<Index>& first, const Operands* operands);

    bool empty() const { return cores_.empty(); }
    /// True if all leaves with a point in K are removed, including leaves of the first operand.
    bool takes_all() const { return !only_second_; }
    /// For each pair of faces of closed components: 1 if their intersection is certainly in K. Fastest if
    /// pairs with the same first face are adjacent. Parallel.
    std::vector<std::uint8_t> hold_meetings(std::span<const std::pair<Index, Index>> pairs) const;
    /// True if a point on a face of the cluster is certainly in K.
    bool holds_point(const NearPoint& p, Index cluster) const;

  private:
    /// The plane of a triangle. A point is certainly behind it when dot(normal, p - at) + unsure + off *
    /// reach is negative.
    struct Wall {
        Vec3 normal, at;
        double unsure, reach;
    };
    struct Core {
        Index component, cluster;
        Box box;
        Vec3 centre;
        double radius;          ///< radius of a ball around the centre inside the core
        std::size_t begin, end; ///< range in walls_
    };
    using Corners = std::array<Vec3, 3>;
    struct Stretch;

    std::vector<std::vector<Index>> triangles_by_component() const;
    std::optional<Core> core_of(std::span<const Index> triangles, bool turned,
                                std::vector<Wall>& walls) const;
    std::vector<std::uint8_t> doubtful(const SelfIntersections& found,
                                       const std::vector<std::uint8_t>& has_core,
                                       const Operands* operands) const;

    Corners corners(Index triangle) const;
    bool holds(const Core& core, const NearPoint& p) const;
    bool holds(const Core& core, const Box& box) const;
    std::vector<Index> cores_near(Index face) const;
    bool holds_meeting(Index f, Index g, const std::vector<Index>& cores) const;
    bool holds_pair(Index s, Index t, const std::vector<Index>& cores) const;
    bool holds_segment(const NearPoint& p, const NearPoint& q, const std::vector<Index>& cores) const;
    bool holds_box(const Box& box, const std::vector<Index>& cores, int& budget) const;
    Stretch stretch_of(const Core& core, const NearPoint& p, const NearPoint& q) const;

    bool may_leave(Index face) const {
        return !only_second_ || (*only_second_)[solids_.components.of_face[face]];
    }

    const Mesh& mesh_;
    const Solids& solids_;
    const std::vector<std::uint8_t>* only_second_ =
        nullptr; ///< [components] 1 for components of the second operand, for an intersection; otherwise null
    const TriangleFaces& triangles_;
    const std::vector<Index>& first_;
    std::vector<Wall> walls_;
    std::vector<Core> cores_;
    std::optional<BoxTree> tree_; ///< tree over cores_
};

} // namespace facetmill::clean_steps
