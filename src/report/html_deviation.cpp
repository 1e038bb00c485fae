// The deviation of a scene from an earlier scene, on a page.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/render/colour_scale.hpp"
#include "geometry/render/srgb.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"
#include "report/svg.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// The number with its sign; zero has no sign.
std::string signed_text(double x) { return x == 0 ? "0" : fmt::format("{:+.3g}", x); }

std::string length_text(const DeviationView& view, double x) {
    const std::string unit = view.unit.empty() ? "" : " " + view.unit;
    if (!(view.diagonal > 0) || !std::isfinite(view.diagonal)) return fmt::format("{:.4g}{}", x, unit);
    return fmt::format("{:.4g}{} ({})", x, unit, percentage(100 * std::abs(x) / view.diagonal));
}

BarChart chart_of(const DeviationView& view, const std::string& id) {
    BarChart chart{.id = id + "-histogram", .title = "Distances from " + view.from};
    double total = 0;
    for (const auto count : view.counts) total += static_cast<double>(count);
    const auto bins = static_cast<double>(view.counts.size());
    for (std::size_t i = 0; i < view.counts.size(); ++i) {
        // Square roots, so that the few distant points are visible next to the many on the surface.
        chart.heights.push_back(std::sqrt(static_cast<double>(view.counts[i]) / std::max(total, 1.0)));
        const Colour c = on_a_diverging_scale((static_cast<double>(i) + 0.5) / bins);
        chart.colours.push_back(
            fmt::format("#{:02x}{:02x}{:02x}", srgb_of(c[0]), srgb_of(c[1]), srgb_of(c[2])));
    }
    for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0})
        chart.ticks.emplace_back(at, signed_text((2 * at - 1) * view.limit));
    chart.scale = true;
    chart.description = fmt::format(
        "Histogram of signed distances, from {} inside to {} outside. The mean absolute distance is {}, the "
        "root mean square {}. The height of a bar is the square root of its share of the points.",
        length_text(view, view.low), length_text(view, view.high), length_text(view, view.mean),
        length_text(view, view.rms));
    return chart;
}

std::string number_rows(const DeviationView& view) {
    const auto row = [](const char* name, const std::string& text) {
        return fmt::format("<tr><th scope=\"row\">{}</th>{}</tr>\n", name, cell(escaped(text)));
    };
    return row("farthest inside", length_text(view, view.low)) +
           row("farthest outside", length_text(view, view.high)) +
           row("mean absolute distance", length_text(view, view.mean)) +
           row("root mean square", length_text(view, view.rms)) +
           row("position of the farthest point", readable(view.worst)) +
           row("points measured", grouped(view.points));
}

std::string beyond_text(const DeviationView& view) {
    return std::max(-view.low, view.high) > view.limit * (1 + 1e-9)
               ? " Larger distances have the colour of the end of the scale."
               : "";
}

std::string caps_text(const DeviationView& view) {
    if (view.caps == 0) return {};
    return (view.caps == 1 ? " The face that closes a cut (cap) is"
                           : fmt::format(" The {} faces that close cuts (caps) are", grouped(view.caps))) +
           fmt::format(" grey and not measured, because {} has no surface there.", escaped(view.from));
}

} // namespace

std::string deviation_html(const DeviationView& view, const std::string& id, const std::string& name,
                           const std::string& whole) {
    const std::string caption =
        fmt::format("{}: signed distance from {}; red is outside, blue inside", name, view.from);
    std::string out = "<div class=\"deviation\">\n";
    if (!view.picture.empty()) out += figure(picture(id + "-colours", caption, view.picture), caption);
    if (!view.behind.empty()) {
        const std::string behind = fmt::format("{}: seen from behind", name);
        out += figure(picture(id + "-behind", behind, view.behind), behind);
    }
    if (!view.close.empty()) {
        const std::string worst = fmt::format("{}: the farthest point, magnified ten times ({})", name,
                                              length_text(view, view.worst_distance));
        out += figure(picture(id + "-worst", worst, view.close), worst);
    }
    out +=
        "<div class=\"wide\">" + svg_of(chart_of(view, id)) +
        fmt::format(
            "<p class=\"soft\">The histogram shows signed distances{} and is the scale of the colours "
            "above. Percentages refer to the diagonal of {}.{}{}{} Surfaces of {} that are missing in {} are "
            "not measured. Stages and checks measure more points, so their maximum may be larger.</p>\n",
            view.unit.empty() ? "" : " in " + escaped(view.unit), escaped(whole.empty() ? view.from : whole),
            beyond_text(view), caps_text(view),
            view.posed ? " Both surfaces are in the pose of the pictures, but stages and checks measure them "
                         "in bind pose."
                       : "",
            escaped(view.from), escaped(name)) +
        subtable("Distances", "", number_rows(view)) + "</div>\n";
    return out + "</div>\n";
}

} // namespace facetmill::report
