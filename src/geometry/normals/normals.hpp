#pragma once
// Gives a mesh new normals (smooth, by face, or none), and merges seams that existing normals make.

#include "mesh/mesh.hpp"

namespace facetmill {

enum class NormalKind {
    keep,   ///< unchanged
    smooth, ///< the mean of the face normals at each vertex, weighted by angles, up to feature edges
    area,   ///< the same, weighted by the areas of the faces
    flat,   ///< the normals of the faces
    none,
};

/// Gives the mesh new normals, in float32. Wedges that only the old normals separated are merged.
///
/// smooth: faces at a vertex share a normal if they are connected by smooth edges. Such an edge has exactly
/// two, consistently oriented faces, which meet at no more than the feature angle (radians; pi: any angle).
/// The normal is the sum of their unit normals times their angles at the vertex (G. Thuermer and C.
/// Wuethrich, "Computing vertex normals from polygonal facets", 1998), which does not depend on how flat
/// areas are cut into triangles. Wedges split where normals differ. area: large faces have more weight, which
/// keeps them flat next to narrow bevels. flat: see set_facet_normals. none: also removes TANGENT, and the
/// changes of both by morph targets, because they would have no meaning.
///
/// Vertices that no face uses are dropped when wedges merge. Other attributes follow their wedges; tangents
/// are made perpendicular again. Faces without area have no weight, and a corner with only such faces gets
/// (0, 0, 0). The result does not depend on the number of threads. Returns the change of NORMAL and, if it
/// changed, of TANGENT.
AttributeChanges give_normals(Mesh& mesh, NormalKind kind, double feature_angle);

struct NormalSeams {
    enum class Shading {
        as_given, ///< nothing to merge
        smoothed, ///< seams below the feature angle were removed, and their normals are new
        faceted,  ///< the mesh was flat-shaded: its normals are removed until set_facet_normals
    };
    Shading shading = Shading::as_given;
    std::size_t merged = 0; ///< removed wedges
};

/// Merges the wedges of a vertex that differ only in NORMAL and TANGENT.
///
/// A mesh is flat-shaded if nearly all bent edges are normal seams and nearly all corners have the normal of
/// their face; then all such wedges are merged. Otherwise wedges are merged across edges whose faces meet at
/// less than the feature angle, and get the area-weighted normal of these faces; sharper seams stay. Seams
/// of any other attribute stay. feature_angle: radians; 0 changes nothing.
///
/// Vertices that no face uses are dropped when something is merged. Merged wedges get the tangent of the
/// first.
[[nodiscard]] NormalSeams merge_normal_seams(Mesh& mesh, double feature_angle);

/// Removes the normals, and merges wedges of a vertex that then differ only in TANGENT (the first wedge's is
/// used). Returns the number of removed wedges. If wedges are merged, vertices that no face uses are
/// dropped.
std::size_t forget_normals(Mesh& mesh);

/// Gives every corner the normal of its face. A wedge is split if the normals of its faces differ by more
/// than half a degree; tangents are made perpendicular. The mesh must have NORMAL.
void set_facet_normals(Mesh& mesh);

} // namespace facetmill
