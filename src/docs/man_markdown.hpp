#pragma once
// A manual page as the other pages of the manual are: in Markdown.

#include <string>
#include <string_view>

namespace facetmill::docs {

/// The text of a page with the macros that man/ uses: headings, paragraphs, lists of terms, examples, fonts.
/// What is bold or italic in the page stands in backticks.
std::string markdown_of_man(std::string_view page);

} // namespace facetmill::docs
