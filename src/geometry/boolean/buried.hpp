#pragma once
// What lies so deep in a union that it need not be cut.

#include "geometry/boolean/boolean_pass.hpp"
#include "geometry/spatial/box_tree.hpp"

#include <optional>
#include <span>

namespace facetmill::clean_steps {

/// A point that floating point knows up to an error: each coordinate is within `off` of the true one.
struct NearPoint {
    Vec3 at;
    double off = 0;
};

/// The open sets that closed components surely wind around, and what lies in them.
///
/// The *core* of a closed component are the points strictly behind the planes of all of its triangles. A ray
/// from such a point leaves through the front of each triangle that it passes through, and one towards a
/// triangle passes through one at least; so the component winds around the point at least once, whatever its
/// shape. The core is convex, being what half-spaces have in common: a segment between two points of it is in
/// it. Of a convex solid it is the inside; of most other solids it is empty, and those are of no use here.
///
/// Let K be the union of the cores of components that bury: of a union all; of a difference those that are
/// taken away; of an intersection those of the second operand (see below). Those are left out whose box meets
/// the box of a component that might wind around something less than zero times (of a difference or an
/// intersection only components of the second operand count): any but those with a core, which wind at least
/// zero times around every point (count along the ray from a point of the core), and those that are manifold,
/// turned outward and are known not to pass through themselves. So in K a union has the winding number 1 at
/// least, and of a difference all is taken away: nowhere there is a face of the result.
///
/// **What meets in K only need not be cut along each other.** Suppose that all other pairs are, and call what
/// is then a piece or an uncut face a leaf.
///
/// 1. Around a point that is not in K all that meets there is cut, as if nothing had been left out.
/// 2. A leaf that has a point in K goes, all of it. K is open, so there is one in its interior, and it goes
///    in K. Were there others not in K, one of them would be on the border of K; around that all is cut, so
///    the leaf has the same on its sides as in K beside it; and so on, since by 1 nothing changes along the
///    leaf outside of K.
/// 3. Any other leaf has the same on its sides all over it, and along each of its edges all that meets there
///    is known, with the same nodes: so to ask at one point of it, and to join it with a neighbour beyond an
///    edge, is right. If the neighbour has a point in K it goes, but then so does this one, having the same
///    on its sides at that edge.
/// 4. A leaf that has a point in K is found to go. Along an edge with a point in K it is joined only with
///    others that go. Asked at its centre, should other triangles hold that, uncut: of each component a ray
///    counts how often it winds around a point just beside the centre (a triangle through the centre is
///    passed by), never less than zero times, and at least once for one whose core holds the centre.
///
/// So each leaf fares as it would if all had been cut. Faces that coincide do not bury each other, since the
/// border of a core is not in it. A face of which some pairs are left out and none remains has a point in K.
///
/// Of an intersection only faces of the second operand are left uncut with each other. With W the winding
/// numbers of the operands: where a leaf has a point in K, the second's W is 1 at least on both of its sides,
/// all along it, as in 2. If the leaf is of the second operand alone, the first's W is the same on both of
/// its sides, so it goes. Any other leaf stays or goes by the first's W alone, and that is the same all along
/// it and along what it is joined with, since faces of the first are cut along all others, and have the same
/// nodes where they meet each other.
///
/// Decided by sums of doubles with a bound of their error: what is not sure is not buried. Solids smaller
/// than 1e-60 or farther out than 1e100 bury nothing, so that no product is lost.
class Buried {
  public:
    /// mesh: with the second operand turned inside out where it is taken away; triangles: of closed
    /// components, those of face f from first[f] to first[f + 1]; found: all pairs of faces that intersect.
    Buried(const Mesh& mesh, const Solids& solids, const SelfIntersections& found,
           const TriangleFaces& triangles, const std::vector<Index>& first, const Operands* operands);

    bool empty() const { return cores_.empty(); }
    /// Whether all leaves with a point in K go, also those of the first operand.
    bool takes_all() const { return !only_second_; }
    /// For each pair whether all that the two faces, both of closed components, have in common is surely in
    /// K. Fastest where pairs of one first face come after each other. Parallel.
    std::vector<std::uint8_t> hold_meetings(std::span<const std::pair<Index, Index>> pairs) const;
    /// Whether a point on a face of the cluster is surely in K.
    bool holds_point(const NearPoint& p, Index cluster) const;

  private:
    /// The plane of a triangle. A point is surely behind it when dot(normal, p - at) + unsure + off * reach
    /// is negative.
    struct Wall {
        Vec3 normal, at;
        double unsure, reach;
    };
    struct Core {
        Index component, cluster;
        Box box;
        Vec3 centre;
        double radius;          ///< of a ball around the centre in the core
        std::size_t begin, end; ///< of walls_
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
    const std::vector<std::uint8_t>* only_second_ = nullptr; ///< [components] of an intersection
    const TriangleFaces& triangles_;
    const std::vector<Index>& first_;
    std::vector<Wall> walls_;
    std::vector<Core> cores_;
    std::optional<BoxTree> tree_; ///< of cores_
};

} // namespace facetmill::clean_steps
