#pragma once
// The report and warnings of transform.

#include "geometry/print_direction/print_direction.hpp"
#include "io/convert.hpp"
#include "stages/transform/options.hpp"

namespace facetmill::transform_stage {

/// The place of the scene on the globe, in degrees.
struct ReportedPlace {
    double lat = 0, lon = 0, height = 0;
    Vec3 geocentric;
};

struct TransformReport {
    Transform all; ///< the combined transform of the parts
    double unit_factor = 1;
    std::optional<double> fit_factor;
    std::optional<PrintDirectionResult> orientation; ///< in the scene's unit before fit
    std::optional<ReportedPlace> globe;
    std::string unit, up; ///< the unit and up axis of the resulting scene
};
void declare_transform_report(DeclareFields<TransformReport>& d);

/// Warns of guesses in the conversion of units or the up axis.
void warn_of_kept_keys(Context& context);
void warn_of_conversion(const io::Conversion& converted, const TransformOptions& o, Context& context);
/// Warns that a part is not baked. reason: "is animated".
void warn_of_kept_node(const std::string& part, const char* reason, Context& context);

} // namespace facetmill::transform_stage
