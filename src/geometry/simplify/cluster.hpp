#pragma once
// Vertex clusters, while a mesh is simplified.

#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

/// A grid's effect.
struct Clusters {
    std::vector<Index> root;  ///< of each vertex of the work: the first one in its cell
    std::vector<Vec3> at;     ///< of roots
    std::vector<Index> faces; ///< that stay, in order
    std::size_t vertices = 0; ///< cells
    double largest = 0;       ///< squared distance to the planes, the mean over a cell
};

/// Sets the faces that stay: those with three roots, of several in one place at most one to each side.
void keep_faces(const Work& s, Clusters& c);

} // namespace facetmill::simplification
