#include "docs/describe.hpp"
#include "docs/stages.hpp"

#include <fmt/format.h>

namespace facetmill::docs {

namespace {

/// Text for a table cell, without bars and line breaks.
std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|')
            out += "\\|";
        else if (c == '<')
            out += "&lt;";
        else
            out += c == '\n' ? ' ' : c;
    }
    return out;
}

std::string option_row(const OptionRow& row) {
    std::string help = row.help;
    for (const auto& c : row.choices)
        if (!c.help.empty()) help += fmt::format(" `{}`: {}.", c.name, c.help);
    const std::string preset = row.required               ? "needed"
                               : row.default_text.empty() ? ""
                                                          : fmt::format("`{}`", cell(row.default_text));
    return fmt::format("| `{}`{} | {} | {} | {} |\n", row.name, row.primary ? " (bare value)" : "",
                       cell(row.type), preset, cell(help));
}

std::string field_row(const FieldRow& row) {
    std::string help = row.help;
    for (const auto& c : row.choices)
        if (!c.help.empty()) help += fmt::format(" `{}`: {}.", c.name, c.help);
    return fmt::format("| `{}` | {} | {} |\n", row.name, cell(row.type), cell(help));
}

} // namespace

std::string stages_markdown_table() {
    std::string text = "| stage | what it does |\n|---|---|\n";
    for (const auto& s : stages()) text += fmt::format("| `{}` | {} |\n", s.name, cell(s.about));
    return text;
}

std::string stages_markdown() {
    std::string text = "# The stages of facetmill\n\nGenerated from their declarations by `facetmill stages "
                       "--markdown`.\n\n" +
                       stages_markdown_table();
    for (const auto& s : stages()) {
        text += fmt::format("\n## {}\n\n{}\n", s.name, s.about);
        if (const std::string details = details_of(s); !details.empty())
            text += fmt::format("\n{}\n", details);
        if (!s.options->shorthand_help.empty())
            text += fmt::format("\nA bare value: {}\n", s.options->shorthand_help);
        const auto options = rows(*s.options);
        if (!options.empty()) text += "\n| option | type | default | what it does |\n|---|---|---|---|\n";
        for (const auto& row : options) text += option_row(row);
        for (const auto& rule : rules(*s.options)) text += fmt::format("\nGiven: {}.\n", rule);
        for (const auto& help : spelling_helps(options)) text += fmt::format("\n{}\n", help);
        if (!s.result->all.empty()) text += "\n| result | type | what it is |\n|---|---|---|\n";
        for (const auto& row : rows(*s.result)) text += field_row(row);
        if (s.examples.empty()) continue;
        text += "\n```yaml\n";
        for (const auto& example : s.examples) text += fmt::format("- {}\n", example);
        text += "```\n";
    }
    return text;
}

} // namespace facetmill::docs
