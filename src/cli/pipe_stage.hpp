#pragma once
// A stage of a one-liner with its bare values and options: simplify 10% --keep-uv.

#include "cli/pipe_words.hpp"

namespace facetmill::cli {

/// Reads the stage at the current word, up to the end of the step. Options in the notation of other programs,
/// a forgotten ! and options of pipe itself (own; null: unknown) are problems.
[[nodiscard]] Value read_stage(PipeWords& words, const Arguments* own);

} // namespace facetmill::cli
