#pragma once
// The side-by-side overview of both files on a comparison page.

#include "diff/comparison.hpp"

namespace facetmill::report {

/// Sizes, counts and soundness side by side; then added, removed and changed parts and materials. HTML.
[[nodiscard]] std::string overview_html(const Comparison& comparison);
/// The overview as Markdown.
[[nodiscard]] std::string overview_markdown(const Comparison& comparison);

/// "closed, manifold, oriented": how many soundness properties hold, and which do not.
[[nodiscard]] std::string soundness_text(const Properties& properties);

/// The heading of a comparison of two files or folders with short names; adds the full paths if different.
/// about: the description of the page.
[[nodiscard]] std::string comparison_begin(const std::pair<std::string, std::string>& names,
                                           const std::pair<std::string, std::string>& paths,
                                           const std::string& about);
/// The heading in Markdown.
[[nodiscard]] std::string comparison_heading(const std::pair<std::string, std::string>& names,
                                             const std::pair<std::string, std::string>& paths);

} // namespace facetmill::report
