#include "base/markup.hpp"
#include "base/readable_numbers.hpp"
#include "report/check_text.hpp"
#include "report/render.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --line: #8884; --good: #2a7d3f; --bad: #c0362c; --warn: #a86400; --soft: #8882; }
@media (prefers-color-scheme: dark) { :root { --good: #6fca86; --bad: #ff8a80; --warn: #f0b45a; } }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin-bottom: .2rem; } h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .3rem .8rem .3rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
code { font-family: ui-monospace, monospace; font-size: .9em; overflow-wrap: anywhere; }
.good { color: var(--good); } .bad { color: var(--bad); } .warn { color: var(--warn); } .soft { opacity: .7; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: .8rem; }
figure { margin: 0; background: var(--soft); border-radius: .4rem; } img { display: block; width: 100%; height: auto; }
figcaption { padding: .3rem .7rem .5rem; font-size: .9em; }
.verdict { font-weight: 600; padding: .6rem 1rem; background: var(--soft); border-radius: .4rem; }
)";

std::string code(const std::string& text) { return fmt::format("<code>{}</code>", escaped(text)); }
std::string cell(const std::string& html) { return fmt::format("<td>{}</td>", html); }
std::string number_cell(const std::string& html) { return fmt::format("<td class=\"number\">{}</td>", html); }

/// A section with a table; nothing when there are no rows.
std::string table(const std::string& title, const std::string& header, const std::string& rows) {
    if (rows.empty()) return {};
    return fmt::format("<h2>{}</h2>\n<div class=\"scroll\"><table>\n<tr>{}</tr>\n{}</table></div>\n", title,
                       header, rows);
}

std::string heads(std::initializer_list<const char*> titles) {
    std::string out;
    for (const std::string title : titles) // a leading # marks a column of numbers
        out += title.starts_with('#') ? fmt::format("<th class=\"number\">{}</th>", title.substr(1))
                                      : fmt::format("<th>{}</th>", title);
    return out;
}

std::string count(const Json& brief, const char* key) {
    return brief.is_object() ? grouped(brief.value(key, std::uint64_t{0})) : "";
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
        for (const auto& [option, length] : s.resolved.items())
            notes +=
                fmt::format("<div>{}: {} = {}</div>", escaped(option), escaped(length.value("given", "")),
                            escaped(length.contains("is") ? length["is"].dump() : ""));
        for (const auto& w : s.warnings)
            notes += fmt::format("<div class=\"warn\">{}: {}</div>", escaped(w.id), escaped(w.message));
        rows += fmt::format("<tr>{}{}{}{}{}{}</tr>\n", cell(escaped(s.name)), cell(code(s.stage)),
                            number_cell(count(s.before, "faces")), number_cell(count(s.after, "faces")),
                            number_cell(count(s.after, "vertices")), cell(notes));
    }
    return rows;
}

std::string pictures(const RunRecord& record) {
    std::string figures;
    for (const auto& s : record.stages) {
        if (s.picture.empty()) continue;
        const std::string caption = fmt::format("{}: {} faces", s.name, count(s.after, "faces"));
        figures += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">"
                               "<figcaption>{0}</figcaption></figure>\n",
                               escaped(caption), s.picture);
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
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, "
        "initial-scale=1\">\n<title>{0}: facetmill "
        "report</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p class=\"soft\">{2}</p>\n",
        escaped(record.pipeline), style, escaped(record.about));
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
    return out + fmt::format("<p class=\"soft\">facetmill {}</p>\n</body>\n</html>\n", FACETMILL_VERSION);
}

} // namespace facetmill::report
