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
    std::vector<std::array<Index, 3>> triangles; ///< into points
    std::vector<Index> cut;                      ///< triangles, ascending
    std::vector<std::pair<Index, Index>> pairs;  ///< pairs to cut that may meet other than in shared points
    /// As many pairs, and crossings of lines in a plane, are worth trying.
    std::size_t max_pairs = 1'000'000, max_crossings = 2'000'000;
};

/// After Q. Zhou, E. Grinspun, D. Zorin and A. Jacobson, "Mesh arrangements for solid geometry" (2016). The
/// nodes are the points, followed by the intersections of triangles; all are kept exactly. Overlapping
/// coplanar triangles are cut together, so that their common area exists once.
class Arrangement {
  public:
    /// A triangle that a piece is part of; sign is 1 when both turn the same way, else -1.
    struct Source {
        Index triangle;
        int sign;
    };
    struct Piece {
        std::array<Index, 3> nodes;
        std::vector<Source> sources; ///< by triangle
    };

    /// Requires finite points; coincident points used by triangles to cut must be merged. Triangles to cut
    /// without area have no pieces; their points are inserted into the other triangles of their pairs.
    explicit Arrangement(TriangleSoup soup);
    ~Arrangement();

    /// A triangle where the most meet, if triangles meet, or lines in a plane could cross, more often than
    /// the soup allows: nothing was cut.
    std::optional<Index> overfull() const;
    /// The pieces of the triangles to be cut, none twice; deterministic.
    const std::vector<Piece>& pieces() const;
    /// The node, rounded: exactly the point where it is one.
    Vec3 position(Index node) const;
    std::size_t node_count() const;
    /// The side of the triangle (0: from its first corner to its second) that contains a node other than its
    /// corners; none for nodes inside.
    std::optional<int> side_of(Index triangle, Index node) const;

    /// A part of a plane, between nodes. Seen from where the triangle, which is of the plane and has area,
    /// turns left, it is on the left of each edge of its border.
    struct Region {
        Index triangle = none;
        std::vector<std::array<Index, 2>> border; ///< nodes; they do not cross, and are not along each other
        std::vector<Index> points;                ///< nodes in the region or on its border
    };
    /// Each region as triangles between all of its nodes, which turn as its triangle does: a constrained
    /// Delaunay triangulation, or one of nearly so good angles. None where a border does not close. Parallel.
    std::vector<std::optional<std::vector<std::array<Index, 3>>>>
    fill(const std::vector<Region>& regions) const;

    /// A ray from the centre of three nodes, which are not on one line, along an axis.
    struct Look {
        std::array<Index, 3> nodes;
        std::vector<Index> but; ///< triangles that it does not see
    };
    struct Seen {
        int way = 0; ///< 1 when the ray begins on the front of the three nodes, else -1
        /// The triangles that it passes through, ascending: sign is 1 when it leaves through their front, -1
        /// when it enters.
        std::vector<Source> hits;
    };
    /// The first hit of each ray. Edges and vertices count once (see `passes` of geometry/spatial/rays.hpp).
    /// Exact, as long as no other triangle contains the centre. All triangles are visited once, so many rays
    /// cost little more than a single ray.
    std::vector<Seen> look_ahead(const std::vector<Look>& looks) const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill
