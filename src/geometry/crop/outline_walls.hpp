#pragma once
// The outline of a crop as upright walls. Only crop uses it.

#include "geometry/polygon/footprint.hpp"
#include "mesh/plane.hpp"

namespace facetmill {

/// The plane through a segment of an outline, parallel to the axis; its normal points to the segment's left.
[[nodiscard]] Plane upright_plane(std::size_t axis, const Vec2& a, const Vec2& b);

/// The outline as walls, with posts at their common corners. A post is numbered by a wall that starts at it.
class Walls {
  public:
    /// The position of a post along a wall.
    struct Stand {
        double at;
        Index post;
    };

    /// rounding: the distance from the outline at which a point still counts as on it (world units).
    Walls(const Footprint& footprint, double rounding);

    std::size_t size() const { return edges().size(); }
    const std::vector<polygon::RingTree::Edge>& edges() const { return footprint_.tree().edges(); }
    /// The position of a point along a wall: 0 to the wall's length, or outside this range beyond its ends.
    double along(Index wall, const Vec2& p) const;
    double length_of(Index wall) const { return lengths_[wall]; }
    /// The largest distance along two walls from their common corner at which a point is on both within
    /// rounding (world units). The second wall is the previous wall in the ring. At a distance d along one
    /// wall, the point is d times the sine of the bend off the other. The result is at most 1/1024 of the
    /// shorter wall, because walls without a bend meet anywhere. This limit was found by experiment. With
    /// 1/16, two meshes of the corpus lost volume; with 2^-20, outlines far from the origin had folded
    /// slivers.
    double spread_of_corner(Index wall) const;
    /// The posts on a wall, ascending; its ends are the first and the last.
    std::span<const Stand> stands(Index wall) const { return stands_[wall]; }
    const Vec2& post(Index number) const { return edges()[number].a; }
    /// The post on the wall that is nearest to a point near the wall; the same for all walls at that post.
    const Stand& nearest_stand(Index wall, const Vec2& p) const;

    /// The wall nearest to an edge projected from p to q. It compares the midpoint's distance from the wall.
    /// Because the edge may extend past the wall, it also compares the distance of its ends from the wall's
    /// line. Rounding is ignored. Among equal walls, the lowest is chosen.
    Index nearest(const Vec2& p, const Vec2& q) const;
    /// True if the edge is on the wall within rounding.
    bool is_on(Index wall, const Vec2& p, const Vec2& q) const;
    double rounding() const { return rounding_; }

  private:
    void find_posts();
    double distance(Index wall, const Vec2& p) const;
    double distance(Index wall, const Vec2& p, const Vec2& q) const;

    const Footprint& footprint_;
    double rounding_;
    std::vector<double> lengths_;
    std::vector<Index> post_; ///< [walls] the post at the start of each wall; walls that start at the same
                              ///< position share a post
    std::vector<std::vector<Stand>> stands_;
};

} // namespace facetmill
