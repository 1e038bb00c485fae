#pragma once
// Where a part stands.

#include "mesh/scene.hpp"

namespace facetmill {

/// The part's transform as it counts, part space -> world: skinned meshes ignore their node's.
inline Transform effective(const Part& part) { return part.skinned ? Transform{} : part.transform; }

} // namespace facetmill
