#pragma once
// Documentation of the stages: `facetmill stages`, its Markdown, and the manual page facetmill-stages(7).
// All texts come from the declarations.

#include "stage/stage.hpp"

namespace facetmill::docs {

/// The paragraphs of a stage, and its policy for faces that intersect themselves.
std::string details_of(const StageInfo& stage);
/// One line per stage.
std::string stage_list();
/// The page of a stage: its effect, options, rules, notation of quantities, and examples.
std::string stage_page(const StageInfo& stage);
/// All stages as a single Markdown page.
std::string stages_markdown();
/// A table of name and purpose in Markdown, for the README.
std::string stages_markdown_table();
/// All stages as a manual page, facetmill-stages(7).
std::string stages_man();
/// The registry as JSON: name, about, details, examples and option rows.
Json stages_json();

} // namespace facetmill::docs
