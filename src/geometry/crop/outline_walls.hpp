#pragma once
// The outline of a crop as upright walls. For crop only.

#include "geometry/polygon/footprint.hpp"
#include "mesh/plane.hpp"

namespace facetmill {

/// The plane along the axis through a segment of an outline; it looks to the segment's left.
Plane upright_plane(std::size_t axis, const Vec2& a, const Vec2& b);

/// The outline as walls, and the corners that they meet at as posts, numbered by a wall that starts there.
class Walls {
  public:
    /// A post on a wall: where along it.
    struct Stand {
        double at;
        Index post;
    };

    /// rounding: how far a point may be off the outline and still be on it (world units).
    Walls(const Footprint& footprint, double rounding);

    std::size_t size() const { return edges().size(); }
    const std::vector<polygon::RingTree::Edge>& edges() const { return footprint_.tree().edges(); }
    /// From 0 to the length of the wall, and beyond its ends.
    double along(Index wall, const Vec2& p) const;
    double length_of(Index wall) const { return lengths_[wall]; }
    /// How far from the corner that a wall shares with the wall behind it in its ring a point may be and
    /// still be on both, within rounding (world units): at a distance d along one it is d times the sine of
    /// the bend off the other. No farther than 1/1024 of the shorter one, as walls
    /// that do not bend meet anywhere; this bound was found by trial: with 1/16 two meshes of the corpus lost
    /// volume, and with 2^-20 outlines far from the origin had folded slivers.
    double spread_of_corner(Index wall) const;
    /// The posts on a wall, ascending; its ends are the first and the last.
    std::span<const Stand> stands(Index wall) const { return stands_[wall]; }
    const Vec2& post(Index number) const { return edges()[number].a; }
    /// The post on the wall that is nearest to a point near the wall; the same for all walls at it.
    const Stand& nearest_stand(Index wall, const Vec2& p) const;

    /// The wall that an edge seen from p to q is nearest to, by its middle and, as it may reach beyond the
    /// wall, its ends' distance from the wall's line; but for rounding, and ties: the lowest.
    Index nearest(const Vec2& p, const Vec2& q) const;
    /// Whether the edge is on that wall but for rounding.
    bool is_on(Index wall, const Vec2& p, const Vec2& q) const;
    double rounding() const { return rounding_; }

  private:
    void find_posts();
    double distance(Index wall, const Vec2& p) const;
    double distance(Index wall, const Vec2& p, const Vec2& q) const;

    const Footprint& footprint_;
    double rounding_;
    std::vector<double> lengths_;
    std::vector<Index> post_; ///< [walls] at the start of each; those at one place have one number
    std::vector<std::vector<Stand>> stands_;
};

} // namespace facetmill
