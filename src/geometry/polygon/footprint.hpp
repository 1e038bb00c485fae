#pragma once
// A checked polygon with holes for cropping, prepared for fast queries.

#include "geometry/polygon/ring_tree.hpp"

#include <cmath>

namespace facetmill {

/// How a face and a segment of the outline meet, both projected along the axis.
enum class OutlineMeeting {
    disjoint,
    touching, ///< they share points, but the segment does not enter the face
    crossing, ///< the segment enters the face, or may enter a concave or edge-on face
};

class Footprint {
  public:
    /// Accepts any number of rings: outlines, holes, and islands in holes, in any order and orientation.
    /// Repeated consecutive corners are dropped, as is a last corner equal to the first. A point in an odd
    /// number of rings is inside. Throws a usage error (E-FOOTPRINT) for numbers that are not finite and for
    /// a ring of fewer than three corners or without area. It also throws, with the position, if rings cross
    /// themselves or each other; touching is allowed.
    explicit Footprint(std::vector<std::vector<Vec2>> rings);

    /// Outlines anticlockwise, holes clockwise: the inside is on the left of every segment.
    const std::vector<std::vector<Vec2>>& rings() const { return rings_; }
    std::vector<polygon::Ring> spans() const { return {rings_.begin(), rings_.end()}; }
    /// The segments of all rings, in order.
    const polygon::RingTree& tree() const { return tree_; }

    /// Like polygon::locate, in logarithmic time.
    polygon::PointLocation locate(const Vec2& p) const;
    /// Calls visit(segment) for the segments that meet the box of that half size around a point, until it
    /// returns false.
    template <class Visit>
    void near(const Vec2& p, const Vec2& reach, Visit&& visit) const {
        tree_.query({p.x - reach.x, p.y - reach.y, p.x + reach.x, p.y + reach.y}, [&](Index i) {
            const auto& e = tree_.edges()[i];
            const Vec2 d = e.b - e.a;
            const double most = std::fabs(d.x) * reach.y + std::fabs(d.y) * reach.x;
            return std::fabs(cross(d, p - e.a)) > most || visit(i);
        });
    }
    double area() const;

  private:
    std::vector<std::vector<Vec2>> rings_;
    polygon::RingTree tree_;
};

/// Exact, except for concave and edge-on faces (see OutlineMeeting).
[[nodiscard]] OutlineMeeting meeting(std::span<const Vec2> face, const Vec2& a, const Vec2& b);

} // namespace facetmill
