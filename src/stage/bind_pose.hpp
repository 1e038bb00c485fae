#pragma once
// Skinned parts, for stages that places in the world are given to.

#include "stage/context.hpp"

namespace facetmill {

/// Warns (W-BIND-POSE) of the parts that the stage works on whose bind pose, which stages see, lies elsewhere
/// than what their joints make of it, which viewers and pictures show: by more than a hundredth of its
/// diagonal somewhere.
void warn_of_bind_pose(const Scene& scene, Context& context);

} // namespace facetmill
