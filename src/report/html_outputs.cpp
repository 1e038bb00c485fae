// The outputs on a page: their shape compared with the input, and their deviation from it.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"
#include "report/svg.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

struct ShapeRow {
    const char* title;
    std::string unit;
    Histogram input, output;
};

std::string tick_text(double x) { return fmt::format("{:.3g}", x); }

std::vector<double> shares(const Histogram& histogram) {
    std::vector<double> all;
    for (const auto count : histogram.counts)
        all.push_back(static_cast<double>(count) /
                      static_cast<double>(std::max<std::uint64_t>(histogram.total, 1)));
    return all;
}

std::string range_of(const Histogram& h, const std::string& unit) {
    return h.total == 0 ? std::string("none")
                        : fmt::format("{:.4g} to {:.4g}{}, mean {:.4g}", h.minimum, h.maximum, unit, h.mean);
}

std::string chart_text(const ShapeRow& row, const std::string& id, bool has_input) {
    BarChart chart{.id = id, .title = row.title};
    chart.heights = shares(row.output);
    if (has_input) chart.outline = shares(row.input);
    const std::size_t bins = chart.heights.size(), steps = bins < 4 ? bins : 4;
    for (std::size_t i = 0; i <= steps; ++i) {
        const std::size_t at = bins * i / steps;
        chart.ticks.emplace_back(static_cast<double>(at) / static_cast<double>(bins),
                                 tick_text(row.output.limits[at]));
    }
    chart.description = fmt::format("{}: {}.", row.title, range_of(row.output, row.unit));
    if (has_input) chart.description += fmt::format(" The input: {}.", range_of(row.input, row.unit));
    return fmt::format(
        "<div class=\"card\"><h4>{}</h4>\n{}<dl class=\"ranges\"><dt>output</dt><dd>{}</dd>{}</dl></div>\n",
        row.title, svg_of(chart), escaped(range_of(row.output, row.unit)),
        has_input ? fmt::format("<dt>input</dt><dd>{}</dd>", escaped(range_of(row.input, row.unit))) : "");
}

std::string shape_html(const OutputView& view, std::size_t number) {
    const std::string unit = view.unit.empty() ? "" : " " + view.unit;
    ShapeRow rows[] = {
        {"Edge length", unit, view.input_shape.edge_length, view.shape.edge_length},
        {"Smallest angle of faces", "°", view.input_shape.smallest_angle, view.shape.smallest_angle},
        {"Aspect ratio of faces", "", view.input_shape.aspect_ratio, view.shape.aspect_ratio}};
    std::string out;
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        trim(rows[i].input, rows[i].output);
        out += chart_text(rows[i], fmt::format("shape-{}-{}", number, i), view.input_faces > 0);
    }
    out = "<div class=\"charts\">\n" + out + "</div>\n";
    std::string note = view.input_faces > 0 ? "Bars show the output, the line shows the input. " : "";
    note += "Heights are shares of all elements. Edge lengths and aspect ratios have a logarithmic scale.";
    if (view.shape.flat_faces > 0)
        note += fmt::format(" {} faces without area have no aspect ratio.", grouped(view.shape.flat_faces));
    return out + fmt::format("<p class=\"soft\">{}</p>\n", note);
}

/// ", 1.2 MB" if a file has the view's name.
std::string size_of(const OutputView& view, const std::vector<FileRecord>& files) {
    for (const FileRecord& file : files)
        if (file.path == view.name) return ", " + sized(file.bytes);
    return {};
}

std::string one_output(const OutputView& view, const RunRecord& record, std::size_t number) {
    std::string out =
        fmt::format("<section class=\"stage\">\n<h3>{}</h3>\n<p>{} faces{}{}</p>\n", escaped_path(view.name),
                    grouped(view.faces),
                    view.input_faces > 0 ? fmt::format(" (input: {})", grouped(view.input_faces)) : "",
                    size_of(view, record.outputs));
    if (view.deviation)
        out += deviation_html(*view.deviation, fmt::format("output-{}", number), view.name);
    else if (!view.no_deviation.empty())
        out += fmt::format("<p>{}</p>\n", escaped(view.no_deviation));
    if (view.faces > 0) out += shape_html(view, number);
    return out + "</section>\n";
}

} // namespace

std::string output_sections(const RunRecord& record) {
    std::string out;
    for (std::size_t i = 0; i < record.views.size(); ++i) out += one_output(record.views[i], record, i + 1);
    return out.empty() ? out : "<h2>Results</h2>\n" + out;
}

} // namespace facetmill::report
