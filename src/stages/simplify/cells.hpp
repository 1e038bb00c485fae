#pragma once
// The stage simplify for a mesh in cells.

#include "stage/stage.hpp"
#include "stages/simplify/options.hpp"

namespace facetmill::simplify_stage {

/// The reason for messages why the options need the whole mesh; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const SimplifyOptions& o);

/// Simplifies the cells and reports as simplify_parts does, without a measured deviation. The result is in
/// memory. As one of several jobs (means.job), it does only that job's work and has no result.
void simplify_on_cells(const SimplifyOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::simplify_stage
