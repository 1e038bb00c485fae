#pragma once
// The mesh after a union: uncut faces, and pieces of cut faces.

#include "geometry/cgal/arrangement.hpp"
#include "mesh/provenance.hpp"

namespace facetmill::clean_steps {

/// An outer piece, and the triangles (of its face) from which its corners take attributes. These triangles
/// contain the corners and have the same orientation. Face attributes come from the first.
struct OuterPiece {
    std::array<Index, 3> nodes;
    std::array<Index, 3> triangles;
};

/// The faces and corners of the arrangement's triangles. The arrangement's first points are the vertices of
/// the mesh.
struct TriangleFaces {
    std::vector<Index> face;                   ///< [triangles] faces
    std::vector<std::array<Index, 3>> corners; ///< [triangles] corners of the face
};

/// How new vertices are snapped.
struct SnapTolerance {
    double tolerance = 0; ///< new vertices within this distance of others merge with them
    bool single = false;  ///< rounds positions to 32-bit floats
};

struct UnitedMesh {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<Index> old_vertices; ///< sources of the first vertices; later vertices are new
};

/// Builds the uncut faces, then the pieces. Vertices and wedges that lose their last face are removed. A new
/// node that rounds to a vertex position, or is within tolerance of a vertex, merges with the lowest such
/// vertex. Pieces that lose a corner by merging are dropped.
[[nodiscard]] UnitedMesh united_mesh(const Mesh& mesh, const std::vector<Index>& uncut,
                                     const std::vector<OuterPiece>& pieces, const Arrangement& arrangement,
                                     const TriangleFaces& triangles, const SnapTolerance& rounding);

} // namespace facetmill::clean_steps
