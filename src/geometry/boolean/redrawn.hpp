#pragma once
// What is kept of faces that were cut, drawn anew without what only the cutting needed.

#include "geometry/boolean/united_mesh.hpp"

namespace facetmill::clean_steps {

/// Cutting leaves nodes where the cut does not show: where it ended in what went, where another solid only
/// touched it, and along lines that crossed a face of which both sides stay. Here they go.
///
/// A *sheet* are the pieces of one triangle, and those of its neighbours that are exactly of its plane, turn
/// as it does, have equal face attributes, and all other attributes as the plane through the corners of one
/// of them has them (but for the rounding of 32-bit floats where they are such): a flat face that happens to
/// be triangulated. An edge is *inner* when it has two pieces, both of one sheet. A node goes when it is no
/// corner of an uncut face, nor of a triangle whose pieces it is a corner of, and
///
/// - all edges at it are inner: it is in the midst of a sheet; or
/// - all but two are, and these are on one line: along both the same sheets meet, two of which are of two
///   planes that have but a line in common; or they are along one side of one triangle.
///
/// The surface as a set of points stays exactly what it was, and stays closed, since what meets at a line
/// loses the same nodes. (An inner edge that an uncut face runs along, too, there is none: such a face would
/// meet the triangle elsewhere than in corners and would have been cut.) Sheets that lose nodes are
/// triangulated again between those that are left. By triangle, ascending; uncut: the faces that stay.
std::vector<OuterPiece> redrawn(const Mesh& mesh, const std::vector<Index>& uncut,
                                std::vector<OuterPiece> pieces, const Arrangement& arrangement,
                                const TriangleFaces& triangles);

} // namespace facetmill::clean_steps
