#pragma once
// Converts a manual page to Markdown, like the other pages of the manual.

#include <string>
#include <string_view>

namespace facetmill::docs {

/// Converts a page with the macros that man/ uses: headings, paragraphs, lists of terms, examples, fonts.
/// Bold and italic text is written in backticks.
[[nodiscard]] std::string markdown_of_man(std::string_view page);

} // namespace facetmill::docs
