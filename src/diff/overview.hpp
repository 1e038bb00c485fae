#pragma once
// The overview of both files side by side on the page of a comparison.

#include "diff/comparison.hpp"

namespace facetmill::report {

/// Sizes, counts and soundness side by side; then added, removed and changed parts and materials. HTML.
std::string overview_html(const Comparison& comparison);
/// The same as Markdown.
std::string overview_markdown(const Comparison& comparison);

/// The soundness of a surface as text: "closed, manifold, oriented" if all properties hold, otherwise their
/// number and the failing ones.
std::string soundness_text(const Properties& properties);

/// The heading of a comparison of two files or folders by short names. Their paths follow if these add
/// information. about: the page's description.
std::string comparison_begin(const std::pair<std::string, std::string>& names,
                             const std::pair<std::string, std::string>& paths, const std::string& about);
/// The same in Markdown.
std::string comparison_heading(const std::pair<std::string, std::string>& names,
                               const std::pair<std::string, std::string>& paths);

} // namespace facetmill::report
