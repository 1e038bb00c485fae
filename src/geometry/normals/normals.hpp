#pragma once
// Normals: new ones for a mesh (smooth, by face, or none), and the seams that given normals make.

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
/// meet at no more than the feature angle (radians; pi: everywhere), share a normal: the sum of their unit
/// normals times their angles at the vertex (G. Thuermer and C. Wuethrich, "Computing vertex normals from
/// polygonal facets", 1998), which does not depend on how flat areas are cut into triangles. Wedges come
/// apart where normals do. flat: see set_facet_normals. none: TANGENT and what morph targets do to both go
/// too, since they would mean nothing.
///
/// Vertices that no face uses are dropped when wedges merge. Other attributes follow their wedges; tangents
/// are made perpendicular again. Faces without area take part with no weight, and a corner that has only such
/// gets (0, 0, 0). The same bytes for any number of threads. Returns the change of NORMAL and, when it
/// changed, TANGENT.
AttributeChanges give_normals(Mesh& mesh, NormalKind kind, double feature_angle);

struct NormalSeams {
    enum class Shading {
        as_given, ///< nothing to merge
        smoothed, ///< seams below the feature angle are gone; the normals there are new
        faceted,  ///< the mesh was flat-shaded: its normals are gone until set_facet_normals
    };
    Shading shading = Shading::as_given;
    std::size_t merged = 0; ///< wedges that went
};

/// Merges the wedges of a vertex that differ in nothing but NORMAL and TANGENT.
///
/// A mesh is flat-shaded when nearly all bent edges are normal seams and nearly all corners have the normal
/// of their face; all such wedges of it are merged. Else wedges are merged across edges where the faces meet
/// at less than the feature angle, and get the area-weighted normal of the faces so joined; sharper seams
/// stay. Seams of any other attribute stay. feature_angle: radians; 0 leaves everything as it is.
///
/// Vertices that no face uses are dropped when something is merged. The tangent of the first wedge is taken.
NormalSeams merge_normal_seams(Mesh& mesh, double feature_angle);

/// Takes the normals away, and merges the wedges of a vertex that differ in nothing else but TANGENT (the
/// first one's is taken). Returns how many wedges went. Vertices that no face uses are dropped then.
std::size_t forget_normals(Mesh& mesh);

/// Gives every corner the normal of its face: wedges are split where the normals of faces that share one
/// differ by more than half a degree, tangents are made perpendicular. The mesh must have NORMAL.
void set_facet_normals(Mesh& mesh);

} // namespace facetmill
