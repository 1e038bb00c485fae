#pragma once
// Report fields of the kinds of face of a mesh, for info and the stages.

#include "geometry/triangulate/triangulate.hpp"
#include "options/fields.hpp"

namespace facetmill {

/// How many faces are of each kind, how many are not planar, and how far the worst is from its plane.
void declare_face_kinds(DeclareFields<FaceKinds>& d);
const Fields& face_kinds_fields();

} // namespace facetmill
