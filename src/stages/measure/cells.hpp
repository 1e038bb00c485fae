#pragma once
// measure, of a mesh in cells.

#include "stages/measure/options.hpp"

namespace facetmill::measure_stage {

/// Why the options need the mesh in memory, in words; none when they do not.
std::optional<std::string> why_not_on_cells(const MeasureOptions& o);
void measure_on_cells(const MeasureOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::measure_stage
