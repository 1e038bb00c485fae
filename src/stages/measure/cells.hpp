#pragma once
// The stage measure for a mesh in cells.

#include "stages/measure/options.hpp"

namespace facetmill::measure_stage {

/// The reason for messages why the options need the mesh in memory; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const MeasureOptions& o);
void measure_on_cells(const MeasureOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::measure_stage
