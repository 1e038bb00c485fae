#pragma once
// Converts lines of a file to parts.

#include "mesh/lines.hpp"
#include "stage/context.hpp"

namespace facetmill::load_stage {

/// Adds a part with tubes to the file's scene for each of the lines. A percentage of thickness refers to the
/// diagonal of the scene with its lines. Warns (W-LINES) if the file has no lines, or if tubes intersect
/// themselves.
void add_tubes(Scene& scene, const std::vector<Lines>& all, const Length& thickness, int sides,
               Context& context);

} // namespace facetmill::load_stage
