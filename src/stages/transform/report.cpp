#include "stages/transform/report.hpp"

#include <fmt/format.h>

namespace facetmill::transform_stage {

namespace {

void declare_direction(DeclareFields<PrintDirection>& d) {
    d.field("overhang_area", &PrintDirection::overhang,
            "The area of faces that look down with a slope below overhang_angle, except faces on the ground.")
        .unit("square scene units");
    d.field("height", &PrintDirection::height, "The height along the up axis.").unit("scene units");
}

void declare_orientation(DeclareFields<PrintDirectionResult>& d) {
    d.object("before", &PrintDirectionResult::before, "Before the turn.", declare_direction);
    d.object("after", &PrintDirectionResult::after, "After the turn.", declare_direction);
}

void declare_place_on_globe(DeclareFields<ReportedPlace>& d) {
    d.field("lat", &ReportedPlace::lat, "The latitude.").unit("degrees");
    d.field("lon", &ReportedPlace::lon, "The longitude.").unit("degrees");
    d.field("height", &ReportedPlace::height, "The height above the ellipsoid.").unit("metres");
    d.field("geocentric", &ReportedPlace::geocentric, "The geocentric coordinates (EPSG:4978).")
        .unit("metres");
}

} // namespace

void declare_transform_report(DeclareFields<TransformReport>& d) {
    const auto rows = [](const TransformReport& r) {
        std::array<std::array<double, 4>, 3> m{};
        for (std::size_t i = 0; i < m.size(); ++i) std::copy_n(r.all.m[i], m[i].size(), m[i].begin());
        return m;
    };
    d.field("matrix", rows,
            "The total movement after the conversion of unit and up axis: the first three rows of a 4 x 4 "
            "matrix.");
    d.field("unit_factor", &TransformReport::unit_factor,
            "The factor that the change of unit applied to lengths.");
    d.field("fit_factor", &TransformReport::fit_factor, "The scale factor of fit.")
        .only_when("fit is given and the scene has parts");
    d.object("orientation", &TransformReport::orientation, "The result of orient_for, measured before fit.",
             declare_orientation)
        .only_when("orient_for is printing and the scene has faces");
    d.object(
         "globe", &TransformReport::globe,
         "The position on the globe: the scene's origin with place, the centre of its bounding box with crs.",
         declare_place_on_globe)
        .only_when("place or crs is given");
    d.field("unit", &TransformReport::unit, "The unit of the scene after this stage, or unknown.");
    d.field("up", &TransformReport::up, "The up axis after this stage, or unknown.");
}

void warn_of_conversion(const io::Conversion& converted, const TransformOptions& o, Context& context) {
    if (converted.unit_guessed)
        context.warn(
            "W-UNITS",
            fmt::format("transform: the scene has no unit, so its numbers are read as {}", to_string(o.unit)),
            "give the unit when you load the file (load: {unit: mm})");
    if (converted.up_guessed)
        context.warn(
            "W-UP",
            fmt::format("transform: the scene has no up axis, so nothing was rotated; the up axis is now {}",
                        to_string(o.up)),
            "give the up axis when you load the file (load: {up: z})");
    if (converted.keys_kept) warn_of_kept_keys(context);
}

void warn_of_kept_keys(Context& context) {
    context.warn("W-TRANSFORM", fmt::format("transform: {}", io::keys_kept_message), io::keys_kept_hint);
}

void warn_of_kept_node(const std::string& part, const char* reason, Context& context) {
    context.warn("W-TRANSFORM", fmt::format("transform: part '{}' {} and is not baked", part, reason),
                 "its node has been moved instead");
}

} // namespace facetmill::transform_stage
