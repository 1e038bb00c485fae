#pragma once
// What the stage simplify does to a mesh in cells.

#include "stage/stage.hpp"
#include "stages/simplify/options.hpp"

namespace facetmill::simplify_stage {

/// Why these options need the whole mesh, in words; none when they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const SimplifyOptions& o);

/// Simplifies the cells and reports as simplify_parts does, without a measured deviation. The result is in
/// memory. Of a job of several (means.job) no more is done than that, and there is no result.
void simplify_on_cells(const SimplifyOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::simplify_stage
