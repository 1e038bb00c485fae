#pragma once
// What is said of the sections of a scene: their sums beside its volume, and what is wrong with them.

#include "io/drawing/drawing.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// Fills the stage's result with the summary of the drawing and, for a stack (spacing above 0, world units),
/// with areas times spacing beside the volume of the parts selected. Warns of contours that are open
/// (W-OPEN-SECTION), turned by nesting (W-UNORIENTED) or crossing themselves (W-SECTION-CROSSES).
void report_sections(const io::Drawing& drawing, const Scene& scene, double spacing, Context& context);

} // namespace facetmill
