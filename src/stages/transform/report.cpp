#include "stages/transform/report.hpp"

#include <fmt/format.h>

namespace facetmill::transform_stage {

void declare_transform_report(DeclareFields<TransformReport>& d) {
    const auto rows = [](const TransformReport& r) {
        std::array<std::array<double, 4>, 3> m{};
        for (std::size_t i = 0; i < m.size(); ++i) std::copy_n(r.all.m[i], m[i].size(), m[i].begin());
        return m;
    };
    d.field("matrix", rows,
            "All moves after the conversion of unit and up axis: the three rows of a matrix.");
    d.field("unit_factor", &TransformReport::unit_factor, "The factor applied to lengths for the unit.");
    d.field("fit_factor", &TransformReport::fit_factor, "The factor by which fit scaled.")
        .only_when("fit is given and there are parts");
    d.field("unit", &TransformReport::unit, "The unit of the scene now; unknown: none.");
    d.field("up", &TransformReport::up, "The axis that points up now; unknown: none.");
}

void warn_of_conversion(const io::Conversion& converted, const TransformOptions& o, Context& context) {
    if (converted.unit_guessed)
        context.warn(
            "W-UNITS",
            fmt::format("transform: the scene had no unit; its numbers are taken as {}", to_string(o.unit)),
            "give the unit when the file is loaded (load: {unit: mm})");
    if (converted.up_guessed)
        context.warn("W-UP",
                     fmt::format("transform: the scene had no up axis; nothing is rotated, and {} is up now",
                                 to_string(o.up)),
                     "give the up axis when the file is loaded (load: {up: z})");
}

void warn_of_kept_node(const std::string& part, const char* reason, Context& context) {
    context.warn("W-TRANSFORM", fmt::format("transform: part '{}' {} and is not baked", part, reason),
                 "its node has been moved instead");
}

} // namespace facetmill::transform_stage
