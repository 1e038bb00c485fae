#pragma once
// Triangles of one plane cut along segments and along each other. Only for the files in this folder.

#include "geometry/cgal/arrangement.hpp"
#include "geometry/cgal/exact_nodes.hpp"

#include <map>

namespace facetmill {

/// What is to be cut: triangles in one plane, with area, that overlap or are one.
struct PlaneGroup {
    std::vector<Index> triangles;
    std::vector<Index> points;                     ///< nodes in the triangles
    std::vector<std::pair<Index, Index>> segments; ///< between nodes, in the triangles
};

/// (triangle, node) -> the side of the triangle that the node is on.
using SidesOfNodes = std::map<std::pair<Index, Index>, int>;

/// Appends the pieces by a constrained triangulation with exact intersections, whose points become nodes. The
/// same for the same input.
void cut_in_plane(const TriangleSoup& soup, const PlaneGroup& group, ExactNodes& nodes,
                  std::vector<Arrangement::Piece>& pieces, SidesOfNodes& sides);

} // namespace facetmill
