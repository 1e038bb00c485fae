#pragma once
// Lines of a file that become parts.

#include "mesh/lines.hpp"
#include "stage/context.hpp"

namespace facetmill::load_stage {

/// Adds a part to the file's scene for each of the lines: tubes of that thickness, a percentage being of the
/// diagonal of the scene with its lines. Warns (W-LINES) where there were none, and where tubes go through
/// themselves.
void add_tubes(Scene& scene, const std::vector<Lines>& all, const Length& thickness, int sides,
               Context& context);

} // namespace facetmill::load_stage
