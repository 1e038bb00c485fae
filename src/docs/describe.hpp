#pragma once
// Shared code of the documentation generators: flattens a declaration into rows, and lays out text in
// columns.

#include "options/declaration.hpp"
#include "options/fields.hpp"

namespace facetmill::docs {

/// An option as shown to people. Fields of a group follow it, with dotted names.
struct OptionRow {
    std::string name;         ///< "iterations", "plane.normal"
    std::string type;         ///< "integer, x >= 1", "one of fast, exact", "length"
    std::string default_text; ///< empty: none
    bool required = false, primary = false, repeatable = false;
    std::string help; ///< includes the short form of a group
    std::vector<Choice> choices;
    Dimension dimension = Dimension::none;
};

std::vector<OptionRow> rows(const Declaration& declaration);
/// A field of a result as shown to people. Fields of an object or a list follow it.
struct FieldRow {
    std::string name; ///< "parts[].before.area"
    std::string type; ///< "number, scene units", "one of faces, edges"
    std::string help; ///< includes when it is null or missing
    std::vector<Choice> choices;
};

std::vector<FieldRow> rows(const Fields& fields);
/// The exclusion rules: "at most one of ratio, faces", one text per rule.
std::vector<std::string> rules(const Declaration& declaration);
/// The notation of a dimension's numbers: "A length is ...", or empty.
std::string spelling_help(Dimension dimension);
/// spelling_help of every dimension that the rows use, once each.
std::vector<std::string> spelling_helps(const std::vector<OptionRow>& rows);

/// Text broken at blanks into lines of at most `width` characters, each indented by `indent` blanks. Words
/// longer than a line get a separate line; line breaks in the text are kept.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width = 100);

/// The text with the lines of each paragraph joined, because help is written as raw strings of short lines.
std::string joined_lines(std::string_view text);

/// Text escaped for roff: no requests, no escapes, and hyphens that can be copied.
std::string roff(std::string_view text);

} // namespace facetmill::docs
