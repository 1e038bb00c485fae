#pragma once
// Faces that cross themselves, for stages that lay a grid on each face.

#include "stage/context.hpp"

namespace facetmill {

/// Warns (W-FANS) of the faces that cross themselves, of the parts that the stage works on: a grid takes
/// faces of four corners at most, so they cannot be filled first, and pieces of them overlap.
void warn_of_crossing_faces_in_grid(const Scene& scene, Context& context);

} // namespace facetmill
