#pragma once
// What transform says of a scene.

#include "io/convert.hpp"
#include "stages/transform/options.hpp"

namespace facetmill::transform_stage {

struct TransformReport {
    Transform all; ///< that moved the parts, as one
    double unit_factor = 1;
    std::optional<double> fit_factor;
    std::string unit, up; ///< of the scene now
};
void declare_transform_report(DeclareFields<TransformReport>& d);

/// Says what was guessed when units or the up axis were converted.
void warn_of_conversion(const io::Conversion& converted, const TransformOptions& o, Context& context);
/// Says that a part is not baked.
void warn_of_animation(const std::string& part, Context& context);

} // namespace facetmill::transform_stage
