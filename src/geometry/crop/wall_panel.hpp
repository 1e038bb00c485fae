#pragma once
// One wall of a crop: the boundary of the kept faces at a segment of the outline, completed and filled. For
// crop only.

#include "geometry/crop/outline_walls.hpp"
#include "geometry/cut/fill_disjoint.hpp"

#include <map>
#include <set>

namespace facetmill {

/// An edge of the kept faces' boundary.
struct WallEdge {
    Index low, high; ///< vertices
    Index edge;      ///< in the edge table
    int count;       ///< faces that run from low to high minus those that run back; never 0
    Index wall;      ///< the segment of the outline that it is at
};

/// The vertices of a mesh as the outline sees them, and those at its posts.
struct PostView {
    const Walls& walls;
    std::vector<Vec2> seen;         ///< [vertices]
    std::vector<double> heights;    ///< [vertices] along the axis
    std::map<Index, Index> post_of; ///< the one post at which a vertex may leave or join walls
    /// The vertices that upright edges run through: those of the post, and others that lie between them.
    std::map<Index, std::set<Index>> at_post;

    /// Puts a vertex at a post, unless it is at a nearer one.
    void stand(Index vertex, Index post);
    /// Where on the wall a vertex is: at a post when it is one of the post's or within rounding.
    double along(Index wall, Index vertex) const;
    /// The vertices of a post, from the lowest up.
    std::vector<Index> ascending(Index post) const;
};

class WallPanel {
  public:
    WallPanel(Index wall, std::span<const WallEdge> edges);

    Index wall() const { return wall_; }
    /// Vertices where not as many edges arrive as leave, and leaving minus arriving.
    const std::map<Index, int>& balance() const { return balance_; }

    /// Adds to the view the vertices that must be known at the posts of this wall.
    void stand_at_posts(PostView& view) const;
    /// Closes the boundary by upright edges at the posts and fills it. False when a post's vertices do not
    /// balance, or the filling needs new points on an upright edge.
    bool complete(const PostView& view);
    /// Vertices that lie on upright edges, with the post: in at_post, complete would use them.
    const std::vector<std::pair<Index, Index>>& missed() const { return missed_; }
    /// The upright edges, as how often each is run from its lower vertex to the other.
    const std::map<std::pair<Index, Index>, int>& upright() const { return upright_; }

    /// A point on an edge of the boundary.
    struct OnEdge {
        Index edge;  ///< of the boundary edges that were given
        Index from;  ///< the end of it that t counts from: a choice by place
        double t;    ///< above 0 and below 1
        Index point; ///< below points().size(): that vertex; else an added one
    };
    const Filling& filling() const { return filling_; }
    const std::vector<Index>& points() const { return points_; } ///< of the filling: vertices
    /// By edge, then from its from on.
    std::vector<OnEdge> on_edges() const;

  private:
    void add_upright(const PostView& view, Index post);
    void make_contours(const PostView& view);
    bool check_upright();
    double parameter(const Contours::Edge& e, Index point) const;
    Vec2 place(Index point) const;

    /// What runs between two vertices.
    struct Run {
        int count = 0;
        Index own = none;  ///< the boundary edge
        Index post = none; ///< the post of an upright one
    };

    Index wall_;
    std::span<const WallEdge> edges_;
    std::map<Index, int> balance_;
    std::map<std::pair<Index, Index>, int> upright_;
    std::map<std::pair<Index, Index>, Run> runs_;
    std::vector<Run> run_of_; ///< [edges of the contours]
    std::vector<std::pair<Index, Index>> missed_;
    std::vector<Index> points_;
    Contours contours_;
    Filling filling_;
    bool balanced_ = true;
};

} // namespace facetmill
