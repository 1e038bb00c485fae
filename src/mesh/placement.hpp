#pragma once
// Where a part stands.

#include "mesh/scene.hpp"

namespace facetmill {

/// The part's transform as it counts, part space -> world: skinned meshes ignore their node's.
inline Transform effective(const Part& part) { return part.skinned ? Transform{} : part.transform; }

/// The place in the world of a point of the part.
inline Vec3 in_world(const Part& part, const Vec3& p) { return part.skinned ? p : part.transform.point(p); }

} // namespace facetmill
