#pragma once
// What the stage simplify does to the parts of a scene.

#include "stage/stage.hpp"
#include "stages/simplify/options.hpp"
#include "stages/simplify/report.hpp"

namespace facetmill::simplify_stage {

/// Simplifies the selected parts, measures and reports what became of each. Parts of the same transform,
/// attributes and shading whose borders touch are simplified as one; other borders that touch another part
/// stay vertex by vertex, so that all match.
Scene simplify_parts(Scene scene, const SimplifyOptions& o, Context& context, SimplifyReport& report);

} // namespace facetmill::simplify_stage
