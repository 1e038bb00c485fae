#pragma once
// Converts a manual page to Markdown, like the other pages of the manual.

#include <string>
#include <string_view>

namespace facetmill::docs {

/// Converts a page with the macros of man/: headings, paragraphs, lists of terms, examples, fonts. Bold and
/// italic text becomes code in backticks.
std::string markdown_of_man(std::string_view page);

} // namespace facetmill::docs
