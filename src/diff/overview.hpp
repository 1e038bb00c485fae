#pragma once
// What a page of a comparison tells of both files beside each other.

#include "diff/comparison.hpp"

namespace facetmill::report {

/// Sizes, counts and soundness side by side; then parts and materials that came, went or changed. HTML.
std::string overview_html(const Comparison& comparison);
/// The same as Markdown.
std::string overview_markdown(const Comparison& comparison);

/// "closed, manifold, oriented" as far as a surface is sound: how many of the properties hold, and which do
/// not.
std::string soundness_text(const Properties& properties);

} // namespace facetmill::report
