#pragma once
// Splits faces into smaller ones, by several methods, without cracks.

#include "mesh/lineage.hpp"

namespace facetmill {

enum class SplitMethod {
    midpoint, ///< edges halved: triangle -> 4 triangles, quad -> 4 quads, n-gon -> n quads around its
              ///< centroid
    bisect,   ///< triangles cut across their longest edge
    centroid, ///< every n-gon -> n triangles around its centroid
    grid,     ///< triangle -> n * n triangles, quad -> n x n quads
    quads,    ///< every n-gon -> n quads around its centroid
    varignon, ///< every n-gon -> the n-gon of its edge midpoints and n triangles at its corners
    core,     ///< every n-gon -> the same shape at half size around its centroid and n quads
    diagonal, ///< quads -> 2 triangles along the shorter diagonal; triangles stay
};

struct SplitSettings {
    SplitMethod method = SplitMethod::midpoint;
    int passes = 1; ///< how many times; at least 0
    int grid = 2;   ///< pieces per edge of SplitMethod::grid; at least 1
};

struct SplitResult {
    Mesh mesh;
    Fates fates;           ///< what became of the attributes
    std::size_t added = 0; ///< faces more than before
};

/// The mesh with every face split. Conforming on open, closed and non-manifold meshes: a point on an edge is
/// one vertex for all faces at the edge, with one wedge per pair of wedges there (seams stay seams), computed
/// once with the edge's ends in index order. Old vertices keep their numbers and places; the faces that
/// replace a face follow each other in its place and keep its direction, so a closed mesh stays closed and
/// Euler's number stays. bisect marks the longest edge of every triangle (ties: the edge of lower vertices)
/// and cuts at each marked edge that the triangle has: two pieces, or three or four where neighbours marked
/// its other edges (Rivara). Requires a valid mesh. Refuses (stage, E-POLYGON) faces that the method does not
/// know: more than four corners for grid and diagonal, more than three for bisect. Throws limit (E-LIMIT)
/// when the result would have more than 2^31 corners, before anything is built. Vertex and wedge attributes
/// are interpolated, face attributes copied. Source: "Facet splitting" (1991-2000 notes); M.-C. Rivara, 1984,
/// for the closure of bisect.
SplitResult split(const Mesh& mesh, const SplitSettings& settings);

/// split with SplitMethod::grid: each triangle into n * n, each quad into n x n; shared edges get the same n
/// - 1 points. n = 1 returns the mesh.
SplitResult grid_split(const Mesh& mesh, int n);

/// An upper bound of the corners that split would make, as a real number because it may be beyond any
/// integer.
double split_corner_estimate(const Mesh& mesh, const SplitSettings& settings);

} // namespace facetmill
