#pragma once
// What transform says of a scene.

#include "io/convert.hpp"
#include "stages/transform/options.hpp"

namespace facetmill {

/// The stage's result: all that moved the parts as one matrix, and the convention the scene is in now.
Json described(const Scene& scene, const io::Conversion& converted, const Transform& all);

/// Says what was guessed, and which skins are lost, when units or the up axis were converted.
void warn_of_conversion(const io::Conversion& converted, const TransformOptions& o, Context& context);
/// Says that a part loses its skin.
void warn_of_skin(const std::string& part, Context& context);
/// Says that a part is not baked.
void warn_of_animation(const std::string& part, Context& context);

} // namespace facetmill
