#pragma once
// Cuts triangles along each other, exactly, and finds the neighbourhood of the pieces. This header does not
// include CGAL, which does the work.

#include "mesh/mesh.hpp"

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace facetmill {

/// Triangles between points, and the subset to cut.
struct TriangleSoup {
    std::vector<Vec3> points;
    std::vector<std::array<Index, 3>> triangles; ///< indices of points
    std::vector<Index> cut;                      ///< triangles, ascending
    std::vector<std::pair<Index, Index>>
        pairs; ///< pairs to cut that may meet elsewhere than in shared points
    /// Limits on pairs, and on crossings of lines in a plane.
    std::size_t max_pairs = 1'000'000, max_crossings = 2'000'000;
};

/// After Q. Zhou, E. Grinspun, D. Zorin and A. Jacobson, "Mesh arrangements for solid geometry" (2016). The
/// nodes are the points, followed by the intersections of triangles; all are kept exactly. Overlapping
/// coplanar triangles are cut together, so that their common area exists once.
class Arrangement {
  public:
    /// A triangle that contains a piece. sign is 1 if both have the same orientation, otherwise -1.
    struct Source {
        Index triangle;
        int sign;
    };
    struct Piece {
        std::array<Index, 3> nodes;
        std::vector<Source> sources; ///< sorted by triangle
    };

    /// Requires finite points; coincident points used by triangles to cut must be merged. Triangles to cut
    /// without area have no pieces; their points are inserted into the other triangles of their pairs.
    explicit Arrangement(TriangleSoup soup);
    ~Arrangement();

    /// If the limits of the soup are exceeded, nothing was cut, and this is the triangle in the most pairs.
    std::optional<Index> overfull() const;
    /// The pieces of the triangles to cut, each once. Deterministic.
    const std::vector<Piece>& pieces() const;
    /// The rounded position of the node; exact if the node is an input point.
    Vec3 position(Index node) const;
    std::size_t node_count() const;
    /// The side of the triangle that contains a node other than its corners (0: from its first to its second
    /// corner). None for nodes inside.
    std::optional<int> side_of(Index triangle, Index node) const;

    /// A part of a plane, between nodes. `triangle` is in the plane and has area. Seen from where the
    /// triangle turns left, the region is on the left of each edge of its border.
    struct Region {
        Index triangle = none;
        std::vector<std::array<Index, 2>> border; ///< edges between nodes that neither cross nor overlap
        std::vector<Index> points;                ///< nodes in the region or on its border
    };
    /// Triangulates each region between all of its nodes, with the orientation of its triangle. It is a
    /// constrained Delaunay triangulation, or has nearly as good angles. None for a region whose border does
    /// not close. Parallel.
    std::vector<std::optional<std::vector<std::array<Index, 3>>>>
    fill(const std::vector<Region>& regions) const;

    /// A ray along an axis from the centre of three nodes, which must not be collinear.
    struct Look {
        std::array<Index, 3> nodes;
        std::vector<Index> but; ///< triangles that the ray ignores
    };
    struct Seen {
        int way = 0; ///< 1 if the ray begins on the front of the three nodes, otherwise -1
        /// The triangles that the ray passes through, ascending. sign is 1 if it leaves through their front,
        /// -1 if it enters.
        std::vector<Source> hits;
    };
    /// The first hit of each ray. Hits on edges and vertices count once (see `passes` of
    /// geometry/spatial/rays.hpp). Exact, as long as no other triangle contains the centre. All triangles
    /// are visited once, so many rays cost little more than a single ray.
    std::vector<Seen> look_ahead(const std::vector<Look>& looks) const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill
