#include "report/svg.hpp"

#include "base/text/markup.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

constexpr double chart_height = 150, bars_top = 6, bars_bottom = 122, strip = 7;

/// Charts with a colour scale are on separate lines, others side by side.
double width_of(const BarChart& chart) { return chart.scale ? 440 : 360; }

double tallest(const BarChart& chart) {
    double most = 0;
    for (const auto* all : {&chart.heights, &chart.outline})
        for (const double height : *all) most = std::max(most, height);
    return most > 0 ? most : 1;
}

/// A low bar is raised enough to be visible.
double top_of(double height, double most) {
    return bars_bottom - std::max(height > 0 ? 1.5 : 0.0, height / most * (bars_bottom - bars_top));
}

std::string bars(const BarChart& chart, double most) {
    std::string out;
    const double wide = width_of(chart) / static_cast<double>(chart.heights.size());
    for (std::size_t i = 0; i < chart.heights.size(); ++i) {
        const double x = wide * static_cast<double>(i);
        const std::string fill =
            i < chart.colours.size() ? fmt::format(" style=\"fill:{}\"", chart.colours[i]) : "";
        const double top = top_of(chart.heights[i], most);
        if (chart.heights[i] > 0)
            out += fmt::format(
                "<rect class=\"bar\"{} x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", fill,
                x + 0.5, top, std::max(0.5, wide - 1), bars_bottom - top);
        if (chart.scale)
            out += fmt::format("<rect{} x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>", fill, x,
                               bars_bottom + 2, wide + 0.2, strip);
    }
    return out;
}

/// A step line over the bars.
std::string outline(const BarChart& chart, double most) {
    if (chart.outline.empty()) return {};
    const double wide = width_of(chart) / static_cast<double>(chart.outline.size());
    std::string path = fmt::format("M0 {}", bars_bottom);
    for (std::size_t i = 0; i < chart.outline.size(); ++i)
        path +=
            fmt::format("V{:.1f}H{:.1f}", top_of(chart.outline[i], most), wide * static_cast<double>(i + 1));
    return fmt::format("<path class=\"before\" d=\"{}V{}\"/>", path, bars_bottom);
}

/// The position of a tick's text.
struct TickText {
    double x;
    const char* anchor;
    double begin, end;
};

TickText tick_text_at(const BarChart& chart, double at, const std::string& text) {
    constexpr double character = 7.2; // width of a wide digit at 12 pixels
    const double x = std::clamp(std::clamp(at, 0.0, 1.0) * width_of(chart), 0.5, width_of(chart) - 0.5);
    const double wide = character * static_cast<double>(text.size());
    if (at < 0.04) return {x, "start", x, x + wide};
    if (at > 0.96) return {x, "end", x - wide, x};
    return {x, "middle", x - wide / 2, x + wide / 2};
}

/// Texts between the two end texts are omitted where they would overlap.
std::string ticks(const BarChart& chart) {
    const double below = bars_bottom + (chart.scale ? strip + 2 : 0);
    std::string out =
        fmt::format("<path class=\"axis\" d=\"M0 {0}H{1}\"/>", bars_bottom + 0.5, width_of(chart));
    constexpr double apart = 4;
    double free = -apart, last = width_of(chart);
    if (!chart.ticks.empty())
        last = tick_text_at(chart, chart.ticks.back().first, chart.ticks.back().second).begin;
    for (std::size_t i = 0; i < chart.ticks.size(); ++i) {
        const auto& [at, text] = chart.ticks[i];
        const TickText stands = tick_text_at(chart, at, text);
        out += fmt::format("<path class=\"axis\" d=\"M{:.1f} {}v4\"/>", stands.x, below);
        const bool is_end = i == 0 || i + 1 == chart.ticks.size();
        if (!is_end && (stands.begin < free + apart || stands.end > last - apart)) continue;
        free = stands.end;
        out += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\">{}</text>", stands.x, below + 16,
                           stands.anchor, escaped(text));
    }
    return out;
}

} // namespace

std::string svg_of(const BarChart& chart) {
    if (chart.heights.empty()) return {};
    const double most = tallest(chart);
    return fmt::format(
        "<svg class=\"chart\" role=\"img\" aria-labelledby=\"{0}-t {0}-d\" viewBox=\"0 0 {1} {2}\">"
        "<title id=\"{0}-t\">{3}</title><desc id=\"{0}-d\">{4}</desc>{5}{6}{7}</svg>\n",
        chart.id, width_of(chart), chart_height, escaped(chart.title), escaped(chart.description),
        bars(chart, most), outline(chart, most), ticks(chart));
}

} // namespace facetmill::report
