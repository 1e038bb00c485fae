#pragma once
// What kinds of face a mesh has, for info and the stages that tell.

#include "base/json.hpp"
#include "geometry/triangulate/triangulate.hpp"

namespace facetmill::report {

/// How many faces are of each kind, how many are not planar, and how far the worst is from its plane.
Json face_kinds_json(const FaceKinds& kinds);

} // namespace facetmill::report
