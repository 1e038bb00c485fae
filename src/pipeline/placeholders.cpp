#include "pipeline/placeholders.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

constexpr std::array<std::string_view, 12> usual{"input", "stem",  "name", "file", "filename", "basename",
                                                 "ext",   "index", "i",    "n",    "lod",      "part"};
constexpr std::array<std::string_view, 5> properties{"stem", "name", "dir", "ext", "index"};

bool is_one_of(const auto& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The word in braces or after a dollar sign, if it is probably meant as an expression.
std::optional<Placeholder> meant(std::string_view text, std::string_view word, bool braces,
                                 const Scope& scope) {
    const auto dot = word.find('.');
    const std::string_view name = word.substr(0, dot);
    if (!is_variable_name(name)) return {};
    const bool known = find_variable(scope, name);
    const bool likely =
        known || is_one_of(usual, name) || (dot != word.npos && is_one_of(properties, word.substr(dot + 1)));
    if (!(braces ? likely : known)) return {};
    return Placeholder{std::string(text), fmt::format("${{{}}}", word), known};
}

/// The end of the name that starts at `at`.
std::size_t name_end(const std::string& text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && is_variable_name("x" + text.substr(end, 1))) ++end;
    return end;
}

void warn(const Value& value, const Placeholder& found, Problems& problems) {
    const std::string hint =
        found.known
            ? fmt::format("write {}", found.expression)
            : fmt::format("an expression is written {}, where {} is a param or the variable of a foreach",
                          found.expression,
                          found.expression.substr(2, found.expression.find_first_of(".}") - 2));
    problems.warn(
        mark_within(value.mark, found.text), "W-PLACEHOLDER",
        fmt::format("'{}' is not an expression, so the file name contains it unchanged", found.text), hint);
}

} // namespace

std::optional<Placeholder> placeholder_in(const std::string& text, const Scope& scope) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text.compare(at, 2, "${") == 0) {
            at = std::min(text.size(), text.find('}', at));
        } else if (text[at] == '{' && (at == 0 || text[at - 1] != '$')) {
            const std::size_t close = text.find('}', at);
            if (close == text.npos) return {};
            const std::string_view word = std::string_view(text).substr(at + 1, close - at - 1);
            const std::size_t begin = at > 0 && text[at - 1] == '@' ? at - 1 : at; // pipe's syntax
            const std::string_view all = std::string_view(text).substr(begin, close - begin + 1);
            if (auto found = meant(all, word, true, scope)) return found;
        } else if (text[at] == '$' || text[at] == '@') {
            const std::size_t end = name_end(text, at + 1);
            const std::string_view all = std::string_view(text).substr(at, end - at);
            if (auto found = meant(all, all.substr(1), false, scope)) return found;
        }
    }
    return {};
}

void warn_of_placeholders(const Value& given, const std::vector<std::string>& outputs, const Scope& scope,
                          Problems& problems) {
    for (const auto& entry : given.entries) warn_of_placeholders(entry.value, outputs, scope, problems);
    if (!given.is_scalar()) return;
    const auto found = placeholder_in(given.text, scope);
    if (!found) return;
    Problems told; // planning the stage reports invalid expressions
    if (is_one_of(outputs, resolved(given, scope, told).text)) warn(given, *found, problems);
}

} // namespace facetmill::pipeline
