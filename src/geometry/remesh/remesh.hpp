#pragma once
// Remeshes a surface with triangles of a given edge length, or with lengths that follow its curvature.

#include "base/refusal.hpp"
#include "mesh/mesh.hpp"

namespace facetmill {

/// Lengths are in the mesh's units.
struct RemeshSettings {
    double length = 0; ///< the edge length; 0: from the curvature, by `tolerance`
    /// The intended distance of the faces from the surface. Edges get the length that keeps an arc with the
    /// curvature of the surface within this distance.
    double tolerance = 0;
    double min_length = 0; ///< with tolerance: the shortest intended edge; 0: the tolerance
    double max_length = 0; ///< with tolerance: the longest intended edge; 0: a 20th of the diagonal
    double feature_angle = 0.7853981633974483; ///< edges whose faces meet at a larger angle stay; radians
    int iterations = 6;
};

struct RemeshResult {
    Mesh mesh;
    AttributeChanges changes;
    double expected_faces = 0;                  ///< from area and lengths, before remeshing
    std::size_t feature_edges = 0;              ///< edges of the result that are features, borders or seams
    std::size_t locked_edges = 0;               ///< non-manifold edges, which are not changed
    std::size_t dropped_faces = 0;              ///< faces of the input with a repeated corner
    double shortest = 0, mean = 0, longest = 0; ///< edges of the result
    std::size_t intersections = 0;              ///< pairs of faces of the result that intersect
    bool input_intersects = false; ///< faces of the input do, too; only if those of the result do
    int retries = 0;               ///< with shorter edges where faces intersected
};

/// Isotropic remeshing after M. Botsch and L. Kobbelt, "A remeshing approach to multiresolution modeling"
/// (2004): splits long edges, collapses short ones, flips edges towards six at a vertex, and moves vertices
/// towards the middle of their neighbours, on the surface. Lengths by curvature follow M. Dunyach et al.,
/// "Adaptive remeshing for real-time mesh deformation" (2013); the curvature follows D. Cohen-Steiner and
/// J.-M. Morvan, "Restricted Delaunay triangulations and normal cycle" (2003). Neighbouring lengths differ by
/// at most half of their distance.
///
/// Every vertex of the result is a point of the input surface, up to rounding. Boundaries, sharp edges, seams
/// of attributes, and borders of materials and of other face attributes with identifiers are kept. Their
/// vertices move only along these lines, and vertices where lines end, meet or turn do not move. Connected
/// sharp edges of less than two lengths in total, and less than a 20th of the diagonal, are noise, and not
/// kept. Non-manifold edges are not changed. No step makes an edge or a vertex non-manifold, turns the normal
/// of a face by more than 60 degrees or removes a component. So a closed, manifold mesh stays closed and
/// manifold.
///
/// Where a wall or a gap is thinner than the edges, faces of the result may intersect. If those of the input
/// do not, remeshing starts again with half the lengths near these faces, at most three times.
///
/// Faces are triangulated first. Faces with a repeated corner are dropped. Attributes are interpolated at the
/// nearest points of the input (geometry/transfer). Seams that only normals make are merged below the feature
/// angle. Throws a usage error (E-RANGE) for settings out of range, and a limit error (E-LIMIT) before any
/// work if the result would have more faces than an index can count. The result does not depend on the number
/// of threads.
[[nodiscard]] RemeshResult remesh(Mesh mesh, const RemeshSettings& settings);

} // namespace facetmill
