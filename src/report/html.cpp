#include "base/markup.hpp"
#include "base/readable_numbers.hpp"
#include "base/words.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
#include "report/render.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

std::string count(const std::optional<Brief>& brief, std::size_t Brief::*member) {
    return brief ? grouped((*brief).*member) : "";
}

template <class Diagnostics>
std::string diagnostics(const Diagnostics& all, const char* kind) {
    std::string rows;
    for (const auto& d : all)
        rows += fmt::format("<tr>{}{}{}{}</tr>\n",
                            cell(fmt::format("<span class=\"{}\">{}</span>", kind, escaped(d.id))),
                            cell(escaped(d.message)), cell(code(to_string(d.where))), cell(escaped(d.hint)));
    return rows;
}

std::string stage_rows(const RunRecord& record) {
    std::string rows;
    for (const auto& s : record.stages) {
        std::string notes = s.skipped ? "<span class=\"soft\">skipped</span>" : "";
        for (const auto& [option, given, is] : s.resolved)
            notes += fmt::format("<div>{}: {} = {}</div>", escaped(option), escaped(given), Json(is).dump());
        for (const auto& w : s.warnings)
            notes += fmt::format("<div class=\"warn\">{}: {}</div>", escaped(w.id), escaped(w.message));
        rows += fmt::format("<tr>{}{}{}{}{}{}</tr>\n", cell(escaped(s.name)), cell(code(s.stage)),
                            number_cell(count(s.before, &Brief::faces)),
                            number_cell(count(s.after, &Brief::faces)),
                            number_cell(count(s.after, &Brief::vertices)), cell(notes));
    }
    return rows;
}

/// "'closed', 'manifold'": the checks of the stage whose places its picture shows; empty when there are none.
std::string shown_failures(const RunRecord& record, const StageRecord& stage) {
    std::string names;
    for (const auto& c : record.checks)
        if (c.stage == stage.name && !failing_locations(c).empty())
            append_item(names, fmt::format("'{}'", c.name));
    return names;
}

std::string pictures(const RunRecord& record) {
    std::string figures;
    for (const auto& s : record.stages) {
        if (s.picture.empty()) continue;
        const std::string failures = shown_failures(record, s);
        const std::string caption =
            failures.empty()
                ? fmt::format("{}: {} faces", s.name, count(s.after, &Brief::faces))
                : fmt::format("{}: where {} did not hold; on the right the first location, magnified", s.name,
                              failures);
        figures += fmt::format("<figure{2}><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">"
                               "<figcaption>{0}</figcaption></figure>\n",
                               escaped(caption), s.picture, failures.empty() ? "" : " class=\"wide\"");
    }
    if (figures.empty()) return {};
    return fmt::format("<h2>Pictures</h2>\n<div class=\"pictures\">\n{}</div>\n<p class=\"soft\">After each "
                       "stage that changed what is seen. The inner side of a surface is orange.</p>\n",
                       figures);
}

std::string check_rows(const RunRecord& record) {
    std::string rows;
    for (const auto& c : record.checks) {
        const char* kind = c.waived                        ? "warn"
                           : c.passed                      ? "good"
                           : c.severity == Severity::error ? "bad"
                                                           : "warn";
        rows += fmt::format("<tr>{}{}{}{}{}{}{}</tr>\n",
                            cell(fmt::format("<span class=\"{}\">{}</span>", kind, outcome(c))),
                            cell(code(c.name)), cell(escaped(c.expected)), cell(escaped(found_text(c))),
                            cell(escaped(c.part)), cell(escaped(locations_text(c))), cell(escaped(c.stage)));
    }
    return rows;
}

std::string attribute_change_rows(const RunRecord& record) {
    std::string rows;
    for (const auto& s : record.stages)
        for (const auto& [part, change] : s.attribute_changes)
            rows += fmt::format("<tr>{}{}{}{}{}{}</tr>\n", cell(escaped(s.name)), cell(escaped(part)),
                                cell(code(change.attribute)), cell(to_string(change.domain)),
                                cell(fmt::format("<span class=\"{}\">{}</span>",
                                                 change.kind == AttributeChange::Kind::dropped ? "warn" : "",
                                                 to_string(change.kind))),
                                cell(escaped(change.why)));
    return rows;
}

std::string file_rows(const std::vector<FileRecord>& files) {
    std::string rows;
    for (const auto& f : files)
        rows += fmt::format("<tr>{}{}{}</tr>\n", cell(code(f.path)), number_cell(sized(f.bytes)),
                            cell(code(f.sha256)));
    return rows;
}

std::string property_rows(const Json& properties) {
    std::string rows;
    if (!properties.is_object()) return rows;
    for (const auto& [name, value] : properties.items())
        if (!value.is_array())
            rows += fmt::format("<tr>{}{}</tr>\n", cell(code(name)),
                                cell(escaped(value.is_string() ? value.get<std::string>() : value.dump())));
    return rows;
}

std::string verdict(const RunRecord& record) {
    if (record.exit_code == 0)
        return "<p class=\"verdict good\">ok: everything held, and all outputs were written</p>\n";
    return fmt::format("<p class=\"verdict bad\">failed with exit code {}{}</p>\n", record.exit_code,
                       record.outputs.empty() ? ": no output was written" : "");
}

} // namespace

std::string to_html(const RunRecord& record) {
    std::string out = html_begin(record.pipeline, record.about);
    out += verdict(record);
    out += table("Errors", heads({"", "what", "where", "hint"}), diagnostics(record.errors, "bad"));
    out += table("Warnings", heads({"", "what", "where", "hint"}), diagnostics(record.warnings, "warn"));
    out +=
        table("Stages", heads({"name", "stage", "#faces before", "#faces after", "#vertices after", "notes"}),
              stage_rows(record));
    out += pictures(record);
    out += table("Checks", heads({"", "property", "expected", "found", "part", "locations", "stage"}),
                 check_rows(record));
    out += table("Outputs", heads({"file", "#size", "SHA-256"}), file_rows(record.outputs));
    out += table("Inputs", heads({"file", "#size", "SHA-256"}), file_rows(record.inputs));
    out += table("Parameters", heads({"name", "value"}), property_rows(record.params));
    out +=
        table("Properties at the end", heads({"property", "value"}), property_rows(record.final_properties));
    out += table("Attribute changes", heads({"stage", "part", "attribute", "domain", "change", "why"}),
                 attribute_change_rows(record));
    return out + html_end();
}

} // namespace facetmill::report
