#pragma once
// Reads a scene back that `write` has staged.

#include "stage/context.hpp"

namespace facetmill {

/// The scene as the file holds it, in the unit and axis of `like` as far as both are known. Meshes keep the
/// coordinates of the file; the conversion is in the transforms. Throws as io::read_scene.
[[nodiscard]] Scene read_written(const WrittenScene& written, const Scene& like, Context& context);

} // namespace facetmill
