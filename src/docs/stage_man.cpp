#include "docs/describe.hpp"
#include "docs/stages.hpp"
#include "facetmill_version.hpp"
#include "stage/common_keys.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::docs {

namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
    return text;
}

std::string option_entry(const OptionRow& row) {
    std::string text = fmt::format(".TP\n.BR {} \" ({}", roff(row.name), roff(row.type));
    if (row.required) text += ", needed";
    if (!row.default_text.empty()) text += ", default " + roff(row.default_text);
    text += row.primary ? "; a bare value sets it)\"\n" : ")\"\n";
    text += roff(row.help) + "\n";
    for (const auto& c : row.choices)
        if (!c.help.empty()) text += fmt::format(".br\n.IR {} :\n{}\n", roff(c.name), roff(c.help));
    return text;
}

std::string field_entry(const FieldRow& row) {
    std::string text =
        fmt::format(".TP\n.BR {} \" ({})\"\n{}\n", roff(row.name), roff(row.type), roff(row.help));
    for (const auto& c : row.choices)
        if (!c.help.empty()) text += fmt::format(".br\n.IR {} :\n{}\n", roff(c.name), roff(c.help));
    return text;
}

std::string section(const StageInfo& s) {
    std::string text = fmt::format(".SH {}\n{}\n", roff(upper(s.name)), roff(s.about));
    if (const std::string details = details_of(s); !details.empty())
        text += fmt::format(".PP\n{}\n", roff(details));
    if (!s.options->shorthand_help.empty())
        text += fmt::format(".PP\nA bare value: {}\n", roff(s.options->shorthand_help));
    for (const auto& row : rows(*s.options)) text += option_entry(row);
    for (const auto& rule : rules(*s.options)) text += fmt::format(".PP\nGiven: {}.\n", roff(rule));
    if (!s.result->all.empty()) text += ".PP\nResult, in the report:\n";
    for (const auto& row : rows(*s.result)) text += field_entry(row);
    if (!s.examples.empty()) text += ".PP\nExamples:\n.PP\n.nf\n.RS\n";
    for (const auto& example : s.examples) text += fmt::format("\\- {}\n", roff(example));
    if (!s.examples.empty()) text += ".RE\n.fi\n";
    return text;
}

} // namespace

std::string stages_man() {
    std::string text = fmt::format(".TH FACETMILL\\-STAGES 7 \"2026-11-21\" \"facetmill {}\" \"facetmill\"\n",
                                   FACETMILL_VERSION);
    text +=
        ".SH NAME\nfacetmill\\-stages \\- the stages of a facetmill pipeline and their options\n"
        ".SH DESCRIPTION\nEach item of a pipeline is one stage with its options.\n"
        "In a pipeline file an option is a key, in\n.B facetmill pipe\nit is\n.BI \\-\\-option \" value\"\n"
        "with the fields of groups dotted.\n";
    text += "Every stage also takes these keys:\n";
    for (const auto& key : common_keys())
        text += fmt::format(".TP\n.B {}\n{}\n", roff(key.name), roff(key.help));
    for (const auto d : {Dimension::length, Dimension::angle, Dimension::ratio})
        text += fmt::format(".PP\n{}\n", roff(spelling_help(d)));
    for (const auto& s : stages()) text += section(s);
    return text + ".SH SEE ALSO\n.BR facetmill (1),\n.BR facetmill\\-pipeline (5),\n"
                  ".BR facetmill\\-messages (7)\n";
}

} // namespace facetmill::docs
