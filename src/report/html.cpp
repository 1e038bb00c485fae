#include "base/markup.hpp"
#include "base/readable_numbers.hpp"
#include "base/words.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
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
        rows += fmt::format("<tr>{}{}{}{}</tr>\n",
                            cell(fmt::format("<span class=\"{}\">{}</span>", kind, escaped(d.id))),
                            cell(escaped(d.message)), cell(code(to_string(d.where))), cell(escaped(d.hint)));
    return rows;
}

std::string check_rows(const RunRecord& record) {
    std::string rows;
    for (const auto& c : record.checks) {
        const char* kind = c.waived                        ? "warn"
                           : c.passed                      ? "good"
                           : c.severity == Severity::error ? "bad"
                                                           : "warn";
        rows += fmt::format("<tr>{}{}{}{}{}{}{}{}</tr>\n",
                            cell(fmt::format("<span class=\"{}\">{}</span>", kind, outcome(c))),
                            cell(code(c.name)), cell(escaped(c.expected)), cell(escaped(found_text(c))),
                            cell(escaped(c.part)), cell(escaped(locations_text(c))), cell(escaped(c.stage)),
                            cell(escaped(c.hint)));
    }
    return rows;
}

std::string file_rows(const std::vector<FileRecord>& files) {
    std::string rows;
    for (const auto& f : files)
        rows += fmt::format("<tr>{}{}{}</tr>\n", cell(code(f.path)), number_cell(sized(f.bytes)),
                            cell(code(f.sha256)));
    return rows;
}

/// What people ask first: how much went in and came out, and whether it held.
std::string glance_rows(const RunRecord& record) {
    const auto row = [](const char* name, const std::string& text) {
        return fmt::format("<tr><th>{}</th>{}</tr>\n", name, cell(text));
    };
    const auto total = [](const std::vector<FileRecord>& files) {
        std::uint64_t bytes = 0;
        for (const auto& file : files) bytes += file.bytes;
        return fmt::format("{} in {}", sized(bytes), counted(files.size(), "file"));
    };
    const StageRecord *first = nullptr, *last = nullptr;
    std::size_t warnings = record.warnings.size();
    for (const auto& stage : record.stages) {
        warnings += stage.warnings.size();
        if (stage.after && !first) first = &stage;
        if (stage.after) last = &stage;
    }
    std::string rows;
    if (first)
        rows += row("faces",
                    fmt::format("{} &rarr; {}", grouped(first->after->faces), grouped(last->after->faces)));
    rows += row("inputs", total(record.inputs)) + row("outputs", total(record.outputs));
    rows += row("checks", passed_text(record) + " passed");
    return rows + row("warnings", grouped(warnings));
}

std::string verdict(const RunRecord& record) {
    return fmt::format("<p class=\"verdict {}\">{}</p>\n", record.exit_code == 0 ? "good" : "bad",
                       verdict_text(record));
}

} // namespace

std::string to_html(const RunRecord& record, const Json& view) {
    std::string out = html_begin(record.pipeline, record.about);
    out += verdict(record);
    out += table("At a glance", "", glance_rows(record));
    out += table("Errors", heads({"id", "what", "where", "hint"}), diagnostics(record.errors, "bad"));
    out += table("Warnings", heads({"id", "what", "where", "hint"}), diagnostics(record.warnings, "warn"));
    out += viewer_section(view);
    out += stage_sections(record);
    out += table("Checks",
                 heads({"outcome", "property", "expected", "found", "part", "locations", "stage", "hint"}),
                 check_rows(record));
    out += table("Outputs", heads({"file", "#size", "SHA-256"}), file_rows(record.outputs));
    out += table("Inputs", heads({"file", "#size", "SHA-256"}), file_rows(record.inputs));
    out += table("Parameters", heads({"name", "value"}), value_rows(record.params));
    out += table("Properties at the end", heads({"property", "value"}), value_rows(record.final_properties));
    return out + html_end();
}

} // namespace facetmill::report
