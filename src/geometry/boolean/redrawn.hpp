#pragma once
// Retriangulates the remaining parts of cut faces without vertices that only the cutting needed.

#include "geometry/boolean/united_mesh.hpp"

namespace facetmill::clean_steps {

/// Cutting leaves nodes where no cut is visible. A cut may end in a removed part, or another solid may only
/// touch the face. A line may also cross a face of which both sides stay. This function removes such nodes.
///
/// A *sheet* contains the pieces of a triangle, and of neighbours that form a flat face with it. These
/// neighbours have exactly the same plane and orientation, and equal face attributes. All other attributes
/// are linear across the triangles (within float rounding). An edge is *inner* when it has two pieces, both
/// of the same sheet. A node is removed if it is not a corner of an uncut face, nor of the triangle of one of
/// its pieces, and
///
/// - all its edges are inner, so it is inside a sheet; or
/// - all but two edges are inner, and these two are collinear. Either the same sheets meet along both, and
///   two of the sheets have different planes; or both are on the same side of a triangle.
///
/// The surface as a point set stays exactly the same. It also stays closed, because all sheets at a line lose
/// the same nodes. (An uncut face never runs along an inner edge: it would meet the triangle elsewhere than
/// in corners, and would have been cut.) Sheets that lose nodes are triangulated again between the remaining
/// nodes. Returns pieces by triangle, ascending. uncut: the uncut faces that stay.
[[nodiscard]] std::vector<OuterPiece> redrawn(const Mesh& mesh, const std::vector<Index>& uncut,
                                              std::vector<OuterPiece> pieces, const Arrangement& arrangement,
                                              const TriangleFaces& triangles);

} // namespace facetmill::clean_steps
