#pragma once
// Describes the stages: `facetmill stages`, its Markdown, and the manual page facetmill-stages(7). All of it
// comes from the declarations.

#include "stage/stage.hpp"

namespace facetmill::docs {

/// The paragraphs of a stage, including its treatment of self-intersecting faces.
[[nodiscard]] std::string details_of(const StageInfo& stage);
/// A line per stage.
[[nodiscard]] std::string stage_list();
/// The page of a stage: its purpose, options, rules, spelling of quantities and examples.
[[nodiscard]] std::string stage_page(const StageInfo& stage);
/// All stages, as one Markdown page.
[[nodiscard]] std::string stages_markdown();
/// A table of name and purpose in Markdown, for the README.
[[nodiscard]] std::string stages_markdown_table();
/// All stages as a manual page, facetmill-stages(7).
[[nodiscard]] std::string stages_man();
/// The registry as JSON: name, about, details, examples and option rows.
[[nodiscard]] Json stages_json();

} // namespace facetmill::docs
