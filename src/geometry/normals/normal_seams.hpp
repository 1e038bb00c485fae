#pragma once
// Seams that only normals make: flat shading cuts a mesh into single faces, and no edge of it could collapse.

#include "mesh/mesh.hpp"

namespace facetmill {

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
