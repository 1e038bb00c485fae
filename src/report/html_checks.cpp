// The checks on a page: expected and found values, failing locations, and how to continue.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

const char* kind_of_check(const Check& c) {
    if (c.waived) return "warn";
    if (c.passed) return "good";
    return c.severity == Severity::error ? "bad" : "warn";
}

std::string outcome_badge(const Check& c) {
    return fmt::format("<span class=\"badge {}\">{}</span>", kind_of_check(c), outcome(c));
}

std::string all_rows(const RunRecord& record) {
    std::string rows;
    for (const Check& c : record.checks)
        rows += fmt::format("<tr>{}{}{}{}{}{}{}</tr>\n", cell(outcome_badge(c)), cell(code(c.name)),
                            cell(escaped(c.expected)), cell(escaped(found_text(c))),
                            cell(escaped(margin_text(c))), cell(escaped(subject_text(c))),
                            cell(escaped(c.stage)));
    return rows;
}

/// A line to copy.
std::string command_line(const char* what, const std::string& command) {
    return fmt::format("<dt>{}</dt><dd><pre tabindex=\"0\">{}</pre></dd>\n", what, escaped(command));
}

/// The known command that fixes the property, on the first input only. Empty if no stage fixes it, or only in
/// the other direction.
std::string mending(const RunRecord& record, const Check& c) {
    const Property* property = property_named(c.name);
    if (!property || property->mend.empty() || c.hint.empty() || record.inputs.empty()) return {};
    return fmt::format("facetmill pipe load {} ! {} ! validate --{} {}",
                       for_shell(record.inputs.front().path), property->mend, c.name, for_shell(c.expected));
}

/// "validate --closed true" accepts "true", but for a number the text may not be a valid value.
bool can_be_asked(const Check& c) {
    return c.expected == "true" || c.expected == "false" ||
           (!c.expected.empty() && c.expected.find_first_not_of("0123456789.") == std::string::npos);
}

std::string places(const Check& c) {
    constexpr std::size_t most = 8;
    if (!c.evidence || c.evidence->size() < 2) return {};
    std::string items;
    const std::size_t shown = std::min(most, c.evidence->size());
    for (std::size_t i = 0; i < shown; ++i)
        items += fmt::format("<li>{}</li>", escaped(evidence_text((*c.evidence)[i])));
    const std::size_t all = std::max(c.locations.value_or(0), c.evidence->size());
    const std::string more = all > shown ? fmt::format("<li>and {} more</li>", grouped(all - shown)) : "";
    return fmt::format("<details><summary>locations</summary><ul>{}{}</ul></details>\n", items, more);
}

std::string term(const char* name, const std::string& text) {
    return text.empty() ? text : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escaped(text));
}

std::string picture_of_check(const Check& c, std::size_t number) {
    if (c.picture.empty()) return {};
    const std::size_t shown = failing_locations(c).size();
    const std::string some = c.locations.value_or(0) > shown
                                 ? fmt::format("the first {} of {} locations", shown, grouped(*c.locations))
                                 : "all locations";
    const std::string caption = fmt::format("{} where '{}' fails; the close-up shows the first, with its "
                                            "faces in red and without the faces that hide them",
                                            some, c.name);
    return figure(picture(fmt::format("check-{}", number), caption, c.picture), caption, true);
}

std::string failure(const RunRecord& record, const Check& c, std::size_t number) {
    std::string terms = term("expected", c.expected) + term("found", found_text(c)) +
                        term("margin", margin_text(c)) + term("part", c.part) + term("file", c.file) +
                        term("evidence", locations_text(c)) + term("where", to_string(c.where)) +
                        term("hint", c.hint);
    if (const std::string mend = can_be_asked(c) ? mending(record, c) : ""; !mend.empty() && !c.passed)
        terms += command_line("try", mend);
    if (!record.command.empty()) terms += command_line("reproduce", record.command);
    return fmt::format("<section class=\"check {}\">\n<h3>{} {} <span class=\"soft\">in {}</span></h3>\n"
                       "<dl>{}</dl>\n{}{}</section>\n",
                       kind_of_check(c), outcome_badge(c), code(c.name), escaped(c.stage), terms,
                       picture_of_check(c, number), places(c));
}

} // namespace

std::string check_section(const RunRecord& record) {
    constexpr std::size_t most = 12;
    std::string out;
    std::size_t failures = 0;
    for (const Check& c : record.checks)
        if ((!c.passed || c.waived) && ++failures <= most) out += failure(record, c, failures);
    if (failures > most)
        out += fmt::format("<p class=\"soft\">{} more failed checks are in the table.</p>\n",
                           grouped(failures - most));
    if (!out.empty()) out = "<h2>Failed checks</h2>\n" + out;
    return out + table("Checks",
                       heads({"outcome", "property", "expected", "found", "margin", "part or file", "stage"}),
                       all_rows(record));
}

} // namespace facetmill::report
