#pragma once
// One wall of a crop: the boundary of the kept faces at a segment of the outline, completed and filled. Only
// crop uses it.

#include "geometry/crop/outline_walls.hpp"
#include "geometry/cut/fill_disjoint.hpp"

#include <map>
#include <set>

namespace facetmill {

/// An edge of the kept faces' boundary.
struct WallEdge {
    Index low, high; ///< vertices
    Index edge;      ///< index in the edge table
    int count;       ///< faces from low to high minus faces in the other direction; never 0
    Index wall;      ///< the nearest segment of the outline
};

/// The projected vertices of a mesh, and the vertices at posts of the outline.
struct PostView {
    const Walls& walls;
    std::vector<Vec2> seen;         ///< [vertices] projected positions
    std::vector<double> heights;    ///< [vertices] coordinates along the axis
    std::map<Index, Index> post_of; ///< the only post at which a vertex may leave or join walls
    /// The vertices that upright edges pass through: vertices at the post, and vertices between them.
    std::map<Index, std::set<Index>> at_post;

    /// Assigns a vertex to a post, unless it already has a nearer one.
    void stand(Index vertex, Index post);
    /// The position of a vertex along the wall: at a post if it is assigned to the post or within rounding.
    double along(Index wall, Index vertex) const;
    /// The vertices of a post, in ascending height.
    std::vector<Index> ascending(Index post) const;
};

class WallPanel {
  public:
    WallPanel(Index wall, std::span<const WallEdge> edges);

    Index wall() const { return wall_; }
    /// The number of leaving minus arriving edges, for vertices where these differ.
    const std::map<Index, int>& balance() const { return balance_; }

    /// Adds the vertices that the view needs at the posts of this wall.
    void stand_at_posts(PostView& view) const;
    /// Closes the boundary with upright edges at the posts and fills it. Returns false when a post's vertices
    /// do not balance, or the filling needs new points on an upright edge.
    bool complete(const PostView& view);
    /// Vertices found on upright edges, with the post. `complete` uses them if they are in at_post.
    const std::vector<std::pair<Index, Index>>& missed() const { return missed_; }
    /// The net count of traversals of each upright edge: upward from its lower vertex adds, downward
    /// subtracts.
    const std::map<std::pair<Index, Index>, int>& upright() const { return upright_; }

    /// A point on an edge of the boundary.
    struct OnEdge {
        Index edge;  ///< index of the given boundary edge
        Index from;  ///< its end with t = 0, chosen by position
        double t;    ///< position along the edge: above 0 and below 1
        Index point; ///< a vertex if below points().size(), otherwise an added point
    };
    const Filling& filling() const { return filling_; }
    const std::vector<Index>& points() const { return points_; } ///< vertices of the filling
    /// The added points on boundary edges, sorted by edge, then along the edge.
    std::vector<OnEdge> on_edges() const;

  private:
    void add_upright(const PostView& view, Index post);
    void make_contours(const PostView& view);
    bool check_upright();
    double parameter(const Contours::Edge& e, Index point) const;
    Vec2 place(Index point) const;

    /// The boundary or upright edges between two vertices.
    struct Run {
        int count = 0;
        Index own = none;  ///< the boundary edge
        Index post = none; ///< the post of an upright edge
    };

    Index wall_;
    std::span<const WallEdge> edges_;
    std::map<Index, int> balance_;
    std::map<std::pair<Index, Index>, int> upright_;
    std::map<std::pair<Index, Index>, Run> runs_;
    std::vector<Run> run_of_; ///< [edges of the contours] their runs
    std::vector<std::pair<Index, Index>> missed_;
    std::vector<Index> points_;
    Contours contours_;
    Filling filling_;
    bool balanced_ = true;
};

} // namespace facetmill
