#pragma once
// The mesh that a union leaves: uncut faces and pieces of cut ones.

#include "geometry/cgal/arrangement.hpp"
#include "mesh/provenance.hpp"

namespace facetmill::clean_steps {

/// A piece on the outside, and the triangles (of the face) that its corners take their attributes from, which
/// hold these and turn as it does. It has the face attributes of the first.
struct OuterPiece {
    std::array<Index, 3> nodes;
    std::array<Index, 3> triangles;
};

/// What the arrangement's triangles are in the mesh. Its first points are the mesh's vertices.
struct TriangleFaces {
    std::vector<Index> face;                   ///< [triangles]
    std::vector<std::array<Index, 3>> corners; ///< [triangles] of the face
};

/// Where new vertices may be.
struct SnapTolerance {
    double tolerance = 0; ///< those that are this near to others become these
    bool single = false;  ///< at positions of 32-bit floats
};

struct UnitedMesh {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<Index> old_vertices; ///< of the first vertices of the mesh; those after them are new
};

/// The uncut faces, then the pieces; vertices and wedges that lose their last face go. New nodes that round
/// to the place of a vertex, or within tolerance of it (the lowest such), become it, and pieces that lose a
/// corner by that are left out.
UnitedMesh united_mesh(const Mesh& mesh, const std::vector<Index>& uncut,
                       const std::vector<OuterPiece>& pieces, const Arrangement& arrangement,
                       const TriangleFaces& triangles, const SnapTolerance& rounding);

} // namespace facetmill::clean_steps
