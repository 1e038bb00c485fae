// The page of a run: its sections, in order.

#include "base/text/markup.hpp"
#include "base/text/short_names.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"
#include "report/html_stages.hpp"
#include "report/render.hpp"
#include "report/viewer.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

template <class Diagnostics>
std::string diagnostics(const Diagnostics& all, const char* kind) {
    std::string rows;
    for (const auto& d : all)
        rows += fmt::format("<tr>{}<td class=\"said\">{}</td>{}<td class=\"said\">{}</td></tr>\n",
                            cell(fmt::format("<span class=\"{}\">{}</span>", kind, escaped(d.id))),
                            escaped(d.message), cell(code(to_string(d.where))), escaped(d.hint));
    return rows;
}

std::string verdict(const RunRecord& record) {
    return fmt::format("<p class=\"verdict {}\">{}</p>\n", record.exit_code == 0 ? "good" : "bad",
                       verdict_text(record));
}

/// The title is the first input; without inputs, the pipeline.
std::string beginning(const RunRecord& record) {
    if (record.inputs.empty()) return html_begin(short_name(record.pipeline), record.about, record.pipeline);
    const std::string pipeline = fmt::format("pipeline {}", short_name(record.pipeline));
    return html_begin(short_name(record.inputs.front().path),
                      record.about.empty() ? pipeline : fmt::format("{} ({})", record.about, pipeline),
                      record.inputs.front().path);
}

std::string page(const RunRecord& record, const Json& view, bool with_times) {
    std::string out = beginning(record);
    out += verdict(record) + glance_section(record, with_times);
    out += table("Errors", heads({"id", "message", "where", "hint"}), diagnostics(record.errors, "bad"));
    out += table("Warnings", heads({"id", "message", "where", "hint"}), diagnostics(record.warnings, "warn"));
    out += check_section(record) + viewer_section(view) + output_sections(record) + stage_sections(record);
    if (with_times) out += times_section(record);
    out += file_sections(record);
    out += table("Properties of the final scene", heads({"property", "value"}),
                 value_rows(record.final_properties));
    out += table("Parameters", heads({"name", "value"}), value_rows(record.params));
    return out + source_section(record) + html_end();
}

} // namespace

std::string to_html(const RunRecord& record, const Json& view) { return page(record, view, false); }
std::string to_html_with_times(const RunRecord& record, const Json& view) { return page(record, view, true); }

} // namespace facetmill::report
