#pragma once
// Report fields of the kinds of faces, for info and the stages.

#include "geometry/triangulate/triangulate.hpp"
#include "options/fields.hpp"

namespace facetmill {

/// Declares the number of faces of each kind, the number of nonplanar faces, and the largest deviation from
/// a plane.
void declare_face_kinds(DeclareFields<FaceKinds>& d);
const Fields& face_kinds_fields();

} // namespace facetmill
