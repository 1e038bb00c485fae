#pragma once
// Normals: new ones for a mesh (smooth, by face, or none), and the seams that given normals make.

#include "mesh/mesh.hpp"

namespace facetmill {

enum class NormalKind {
    keep,   ///< as they are
    smooth, ///< at each vertex the mean of the face normals, weighted by angles, up to feature edges
    flat,   ///< the normals of the faces
    none,
};

/// Gives the mesh other normals, in float32. Wedges that only the old normals kept apart are merged.
///
/// smooth: faces at a vertex share a normal if they meet along edges of exactly two faces, which agree about
/// the outside and meet at no more than the feature angle (radians; pi: everywhere). This normal is the sum
/// of their unit normals times their angles at the vertex (G. Thuermer and C. Wuethrich, "Computing vertex
/// normals from polygonal facets", 1998), which does not depend on how flat areas are cut into triangles.
/// Wedges split where normals differ. flat: see set_facet_normals. none: also removes TANGENT and the changes
/// of both by morph targets, since they would have no meaning.
///
/// Vertices that no face uses are dropped when wedges merge. Other attributes follow their wedges; tangents
/// are made perpendicular again. Faces without area have no weight, and a corner with only such faces gets
/// (0, 0, 0). The same bytes for any number of threads. Returns the change of NORMAL and, when it changed,
/// TANGENT.
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

/// Merges the wedges of a vertex that differ only in NORMAL and TANGENT.
///
/// A mesh is flat-shaded if nearly all bent edges are normal seams and nearly all corners have the normal of
/// their face; then all such wedges are merged. Otherwise wedges are merged across edges whose faces meet at
/// less than the feature angle, and get the area-weighted normal of these faces; sharper seams stay. Seams of
/// any other attribute stay. feature_angle: radians; 0 changes nothing.
///
/// Vertices that no face uses are dropped when something is merged. The tangent of the first wedge is taken.
[[nodiscard]] NormalSeams merge_normal_seams(Mesh& mesh, double feature_angle);

/// Takes the normals away, and merges the wedges of a vertex that differ in nothing else but TANGENT (the
/// first one's is taken). Returns how many wedges went. Vertices that no face uses are dropped then.
std::size_t forget_normals(Mesh& mesh);

/// Gives every corner the normal of its face. A wedge is split if the normals of its faces differ by more
/// than half a degree; tangents are made perpendicular. The mesh must have NORMAL.
void set_facet_normals(Mesh& mesh);

} // namespace facetmill
