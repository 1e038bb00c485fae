#pragma once
// validate, of a mesh in cells.

#include "stage/assertions.hpp"
#include "stage/stage.hpp"

namespace facetmill::validate_stage {

/// Why the assertions need the mesh in memory, in words; none when they do not.
std::optional<std::string> why_not_on_cells(const Assertions& assertions);
/// Adds one check to the context for every assertion. Without evidence: that needs the mesh in memory.
void judge_cells(Assertions assertions, Severity severity, const CellFlow& flow, Context& context);

} // namespace facetmill::validate_stage
