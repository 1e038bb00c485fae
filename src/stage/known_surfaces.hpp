#pragma once
// Stages in a row: what one leaves of the surface is what the next one finds.

#include "stage/stage.hpp"

#include <optional>

namespace facetmill {

/// As the other perform. surfaces: those of the scene, if they are known; then those of what is returned, or
/// none, also where this throws.
Scene perform(const Stage& stage, Scene scene, Context& context,
              std::optional<std::vector<PartSurface>>& surfaces);

} // namespace facetmill
