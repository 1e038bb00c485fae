#pragma once
// Warnings about skinned parts, for stages with positions in their options.

#include "stage/context.hpp"

namespace facetmill {

/// Warns (W-BIND-POSE) about selected parts whose bind pose, which stages use, differs from the posed skin,
/// which viewers and pictures show. The limit is a hundredth of the part's diagonal.
void warn_of_bind_pose(const Scene& scene, Context& context);

} // namespace facetmill
