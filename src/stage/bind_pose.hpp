#pragma once
// Warnings about skinned parts, for stages with positions in their options.

#include "stage/context.hpp"

namespace facetmill {

/// Warns (W-BIND-POSE) about selected parts whose bind pose, which stages use, differs from the posed skin,
/// which viewers and pictures show. The limit is a hundredth of the part's diagonal.
void warn_of_bind_pose(const Scene& scene, Context& context);

/// Whether a skin or morph targets move the vertices of the part away from its rest pose.
[[nodiscard]] bool has_poses(const Part& part);
/// Warns (W-REST-POSE) that a limit of the deviation holds for the rest pose of these parts alone. limit:
/// "max_error". parts: their names; empty: no warning.
void warn_of_rest_pose(const std::string& limit, const std::vector<std::string>& parts, Context& context);

} // namespace facetmill
