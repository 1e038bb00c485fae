#include "docs/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace facetmill::docs {

namespace {

std::string type_text(const Option& o) {
    if (!o.choices.empty()) {
        std::vector<std::string> names;
        for (const auto& c : o.choices) names.push_back(c.name);
        return fmt::format("{} {}", o.repeatable ? "list of" : "one of", fmt::join(names, ", "));
    }
    std::string text(to_string(o.kind));
    if (o.dimension == Dimension::bytes) text += " of bytes";
    if (o.kind == OptionKind::list && o.dimension == Dimension::length) text += " of lengths";
    if (o.kind == OptionKind::list && o.dimension == Dimension::ratio) text += " of ratios";
    if (o.kind == OptionKind::list && o.dimension == Dimension::angle) text += " of angles";
    if (o.kind == OptionKind::bound && o.dimension == Dimension::angle) text += " of an angle";
    if (o.kind == OptionKind::bound && o.dimension == Dimension::length) text += " of a length";
    if (const auto range = o.range.to_string(); !range.empty()) text += ", " + range;
    return text;
}

void collect(const Declaration& declaration, const std::string& prefix, std::vector<OptionRow>& out) {
    for (const auto& o : declaration.options) {
        OptionRow row{prefix + o.name, type_text(o), o.default_text, o.required, o.primary && prefix.empty(),
                      o.repeatable,    o.help,       o.choices,      o.dimension};
        if (o.fields && !o.fields->shorthand_help.empty()) row.help += " Short: " + o.fields->shorthand_help;
        out.push_back(std::move(row));
        if (o.fields) collect(*o.fields, prefix + o.name + ".", out);
    }
}

std::string type_text(const Field& field) {
    if (field.choices.empty()) return field.type + (field.unit.empty() ? "" : ", " + field.unit);
    std::vector<std::string> names;
    for (const auto& c : field.choices) names.push_back(c.name);
    return fmt::format("one of {}", fmt::join(names, ", "));
}

void collect(const Fields& fields, const std::string& prefix, std::vector<FieldRow>& out) {
    for (const auto& field : fields.all) {
        FieldRow row{prefix + field.name + (field.is_list ? "[]" : ""), type_text(field), field.help,
                     field.choices};
        if (!field.null_when.empty()) row.help += fmt::format(" Null when {}.", field.null_when);
        if (!field.only_when.empty()) row.help += fmt::format(" Present only when {}.", field.only_when);
        const std::string inner = row.name + ".";
        out.push_back(std::move(row));
        if (field.fields) collect(*field.fields, inner, out);
    }
}

} // namespace

std::vector<FieldRow> rows(const Fields& fields) {
    std::vector<FieldRow> all;
    collect(fields, "", all);
    return all;
}

std::vector<OptionRow> rows(const Declaration& declaration) {
    std::vector<OptionRow> all;
    collect(declaration, "", all);
    return all;
}

std::vector<std::string> rules(const Declaration& declaration) {
    std::vector<std::string> all;
    for (const auto& rule : declaration.exclusions) {
        const char* word = rule.rule == Exclusion::Rule::at_most_one   ? "at most one"
                           : rule.rule == Exclusion::Rule::exactly_one ? "exactly one"
                                                                       : "at least one";
        all.push_back(fmt::format("{} of {}", word, fmt::join(rule.names, ", ")));
    }
    return all;
}

std::string spelling_help(Dimension dimension) {
    switch (dimension) {
    case Dimension::length:
        return "A length is a number in scene units (2), a number with a unit (2mm, 0.1in), or a percentage "
               "of the diagonal of a bounding box. 0.5% refers to the scene that enters the stage, 0.5% of "
               "part to the part, and 0.5% of load to the scene as last loaded.";
    case Dimension::angle:
        return "An angle is in degrees (30, 30deg) or radians (0.5rad).";
    case Dimension::ratio:
        return "A ratio is a percentage (25%) or a number with a point (0.25).";
    case Dimension::none:
    case Dimension::count:
    case Dimension::bytes:
        break;
    }
    return {};
}

std::vector<std::string> spelling_helps(const std::vector<OptionRow>& all) {
    std::vector<std::string> helps;
    for (const auto dimension : {Dimension::length, Dimension::angle, Dimension::ratio})
        for (const auto& row : all)
            if (row.dimension == dimension) {
                helps.push_back(spelling_help(dimension));
                break;
            }
    return helps;
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
    std::string out, line;
    const auto flush = [&] {
        if (!line.empty()) out += std::string(indent, ' ') + line;
        out += '\n';
        line.clear();
    };
    for (std::size_t at = 0; at < text.size();) {
        if (text[at] == '\n') {
            flush();
            ++at;
            continue;
        }
        if (text[at] == ' ') {
            ++at;
            continue;
        }
        const auto end = std::min(text.find_first_of(" \n", at), text.size());
        const auto word = text.substr(at, end - at);
        if (!line.empty() && indent + line.size() + 1 + word.size() > width) flush();
        if (!line.empty()) line += ' ';
        line += word;
        at = end;
    }
    if (!line.empty()) flush();
    return out;
}

std::string roff(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if ((c == '.' || c == '\'') && (i == 0 || text[i - 1] == '\n')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

std::string joined_lines(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool paragraph = (i > 0 && text[i - 1] == '\n') || (i + 1 < text.size() && text[i + 1] == '\n');
        out += text[i] == '\n' && !paragraph ? ' ' : text[i];
    }
    return out;
}

} // namespace facetmill::docs
