#pragma once
// Self-intersecting faces, for stages that apply a grid to each face.

#include "stage/context.hpp"

namespace facetmill {

/// Warns (W-FANS) about self-intersecting faces of the selected parts. A grid needs faces of at most four
/// corners, so they cannot be filled first, and their pieces overlap.
void warn_of_crossing_faces_in_grid(const Scene& scene, Context& context);

} // namespace facetmill
