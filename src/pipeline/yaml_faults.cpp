#include "pipeline/yaml_faults.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

struct Said {
    std::string message, hint;
};

/// The text from `at` to the end of the value: before a comma, a closing bracket or brace, a comment or the
/// end of the line.
std::string value_at(const std::string& text, std::size_t at) {
    const std::size_t end = std::min(text.size(), text.find_first_of(",]}\r\n", at));
    std::string value = text.substr(at, end - at);
    if (const auto comment = value.find(" #"); comment != std::string::npos) value.resize(comment);
    value.resize(value.find_last_not_of(" \t") + 1);
    return value;
}

/// The line of byte `at` without its end.
std::string line_of(const std::string& text, std::size_t at) {
    const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

bool is_indented_by_tab(const std::string& text, std::size_t at) {
    const std::string line = line_of(text, at);
    return line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos;
}

/// "- relax" with "when: ..." below: the name needs a colon before more keys.
std::string bare_item_hint(const std::string& text, std::size_t at) {
    const std::size_t line = text.rfind('\n', std::min(at, text.size() - 1) - (at > 0 ? 1 : 0));
    if (text.empty() || line == std::string::npos || line == 0) return {};
    std::string above = line_of(text, line - 1);
    above.erase(0, above.find_first_not_of(' '));
    if (!above.starts_with("- ") || above.find_first_of(":{}[]\"'#") != std::string::npos) return {};
    return fmt::format("a stage with more keys needs a colon: write '{}:' in the line above", above);
}

/// A hint for a quoted text that ended unexpectedly, just before byte `at`.
std::string quote_hint(const SourceIndex& source, const Extent& quoted, std::size_t at) {
    const std::string& text = source.text();
    const std::string_view between = std::string_view(text).substr(quoted.end, at - quoted.end);
    if (between.find_first_not_of(" ,:") != std::string_view::npos) return {};
    const std::string_view inside = std::string_view(text).substr(quoted.begin, quoted.end - quoted.begin);
    if (inside.find('\n') != std::string_view::npos)
        return fmt::format(
            "this quote closes the quote that opens in line {}: close that quote in its own line",
            source.mark(quoted.begin).line);
    if (at != quoted.end) return {};
    return text[quoted.begin] == '\'' ? "inside '...' a ' is written '', or take \"...\""
                                      : "inside \"...\" a \" is written \\\"";
}

/// A value that begins with a special character of YAML.
std::optional<Said> special_character(const std::string& text, std::size_t at) {
    if (at >= text.size() || std::string_view("*%@`&").find(text[at]) == std::string_view::npos) return {};
    const std::string value = value_at(text, at);
    if (text[at] == '%' && value.size() > 1 && value.find_first_not_of("0123456789.", 1) == std::string::npos)
        return Said{"a value cannot begin with '%'", fmt::format("write {}%", value.substr(1))};
    const std::string quoted = fmt::format("in quotes it is a text: \"{}\"", value);
    if (text[at] == '*') return Said{fmt::format("no anchor is named by '{}'", value), quoted};
    return Said{fmt::format("a value cannot begin with '{}'", text[at]), quoted};
}

Said in_words(const std::string& said) {
    if (said == "end of map flow not found")
        return {"expected ',' or '}' here", "a text with special characters must be quoted"};
    if (said == "end of sequence flow not found")
        return {"expected ',' or ']' here", "a text with special characters must be quoted"};
    if (said == "illegal map value")
        return {"unexpected ':'", "quote texts that contain ': ', and check the indentation"};
    if (said == "end of map not found") return {"expected a key of the map here", "mind the indentation"};
    if (said == "end of sequence not found")
        return {"expected an item of the list ('- ...') here", "mind the indentation"};
    if (said == "illegal block entry") return {"unexpected list item ('- ...')", "mind the indentation"};
    if (said == "illegal EOF in scalar") return {"the quote is never closed", ""};
    return {said, ""};
}

} // namespace

std::optional<std::size_t> end_of_quoted(const std::string& all, std::size_t at) {
    const char quote = all[at];
    for (std::size_t i = at + 1; i < all.size(); ++i) {
        if (quote == '"' && all[i] == '\\')
            ++i;
        else if (quote == '\'' && all.compare(i, 2, "''") == 0)
            ++i;
        else if (all[i] == quote)
            return i + 1;
    }
    return {};
}

Diagnostic yaml_fault(const SourceIndex& source, std::size_t at, const std::string& said,
                      const ReadSoFar& read) {
    const std::string& text = source.text();
    at = std::min(at, text.size());
    Said is = special_character(text, at).value_or(in_words(said));
    const Mark where = source.mark(at);
    if (const std::string hint = bare_item_hint(text, at); !hint.empty()) is.hint = hint;
    if (read.open && read.open->line < where.line)
        is.hint = fmt::format("the bracket at line {}, column {} is not closed", read.open->line,
                              read.open->column);
    if (read.quoted && read.quoted->end <= at)
        if (const std::string hint = quote_hint(source, *read.quoted, at); !hint.empty()) is.hint = hint;
    if (is_indented_by_tab(text, at)) is.hint = "indent with spaces: YAML does not allow tabs there";
    return {Severity::error, "E-YAML", is.message, where, is.hint};
}

std::string tag_hint(const std::string& tag) {
    return fmt::format("leave it out; a text that begins with ! is quoted: \"{}\"", tag);
}

} // namespace facetmill::pipeline
