#pragma once
// New normals for a mesh: smooth, by face, or none.

#include "mesh/mesh.hpp"

namespace facetmill {

enum class NormalKind {
    keep,   ///< as they are
    smooth, ///< at each vertex the mean of the faces around, weighted by their angles there, up to feature
            ///< edges
    flat,   ///< those of the faces
    none,
};

/// Gives the mesh other normals, in float32. Wedges that only the old normals kept apart become one.
///
/// smooth: faces at a vertex that meet along edges of exactly two faces, which agree about the outside and
/// bend by at most the feature angle (radians; pi: everywhere), share a normal: the sum of their unit normals
/// times their angles at the vertex (Thuermer and Wuethrich, Computing vertex normals from polygonal facets,
/// 1998), which does not depend on how flat areas are cut into triangles. Wedges come apart where normals do.
/// flat: see set_facet_normals. none: TANGENT and what morph targets do to both go too, since they would mean
/// nothing.
///
/// Vertices that no face uses are dropped when wedges merge. Other attributes follow their wedges; tangents
/// are made perpendicular again. Faces without area take part with no weight, and a corner that has only such
/// gets (0, 0, 0). The same bytes for any number of threads. Returns the change of NORMAL and, when it changed,
/// TANGENT.
AttributeChanges give_normals(Mesh& mesh, NormalKind kind, double feature_angle);

} // namespace facetmill
