#pragma once
// Consecutive stages: the surface measured after one stage is reused by the next.

#include "stage/stage.hpp"

#include <optional>

namespace facetmill {

/// Like the other perform. surfaces: the surfaces of the scene, if known; replaced by the surfaces of the
/// result, or none. Also none if this throws.
[[nodiscard]] Scene perform(const Stage& stage, Scene scene, Context& context,
                            std::optional<std::vector<PartSurface>>& surfaces);

} // namespace facetmill
