#pragma once
// Shared code of the generators: a declaration flattened into rows, and text laid out in columns.

#include "options/declaration.hpp"
#include "options/fields.hpp"

namespace facetmill::docs {

/// A row of an option for users. Fields of a group follow it, with dotted names.
struct OptionRow {
    std::string name;         ///< "iterations", "plane.normal"
    std::string type;         ///< "integer, x >= 1", "one of fast, exact", "length"
    std::string default_text; ///< empty: none
    bool required = false, primary = false, repeatable = false;
    std::string help; ///< with the shorthand of a group
    std::vector<Choice> choices;
    Dimension dimension = Dimension::none;
};

[[nodiscard]] std::vector<OptionRow> rows(const Declaration& declaration);
/// A row of a field of a result for users. Fields of an object or a list follow it.
struct FieldRow {
    std::string name; ///< "parts[].before.area"
    std::string type; ///< "number, scene units", "one of faces, edges"
    std::string help; ///< including when it is null or missing
    std::vector<Choice> choices;
};

[[nodiscard]] std::vector<FieldRow> rows(const Fields& fields);
/// "at most one of ratio, faces", one per rule.
[[nodiscard]] std::vector<std::string> rules(const Declaration& declaration);
/// Explains the spelling of a dimension's numbers: "A length is ...", or empty.
[[nodiscard]] std::string spelling_help(Dimension dimension);
/// spelling_help of every dimension that the rows use, once each.
[[nodiscard]] std::vector<std::string> spelling_helps(const std::vector<OptionRow>& rows);

/// Wraps text into lines of at most `width` characters, and indents each by `indent` blanks. A longer word
/// gets its own line. Line breaks in the text stay.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t indent, std::size_t width = 100);

/// The lines of each paragraph joined: help is written as raw strings of short lines.
[[nodiscard]] std::string joined_lines(std::string_view text);

/// Escapes a text for roff: no requests or escapes, and hyphens that can be copied.
[[nodiscard]] std::string roff(std::string_view text);

} // namespace facetmill::docs
