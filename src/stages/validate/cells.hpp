#pragma once
// The stage validate for a mesh in cells.

#include "stage/assertions.hpp"
#include "stage/stage.hpp"

namespace facetmill::validate_stage {

/// The reason for messages why the assertions need the mesh in memory; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const Assertions& assertions);
/// Adds a check to the context for every assertion. Checks have no evidence, because evidence needs the mesh
/// in memory.
void judge_cells(Assertions assertions, Severity severity, const CellFlow& flow, Context& context);

} // namespace facetmill::validate_stage
