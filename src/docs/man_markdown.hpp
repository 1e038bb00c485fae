#pragma once
// A manual page as the other pages of the manual are: in Markdown.

#include <string>
#include <string_view>

namespace facetmill::docs {

/// Converts a page with the macros that man/ uses: headings, paragraphs, lists of terms, examples, fonts.
/// Bold and italic text is written in backticks.
[[nodiscard]] std::string markdown_of_man(std::string_view page);

} // namespace facetmill::docs
