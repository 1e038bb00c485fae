#pragma once
// The stage validate for a mesh in cells.

#include "stage/assertions.hpp"
#include "stage/stage.hpp"
#include "stages/validate/scene_limits.hpp"

namespace facetmill::validate_stage {

/// The reason for messages why the assertions need the mesh in memory; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const Assertions& assertions);
/// Adds a check to the context for every assertion. Checks have no evidence, which needs the mesh in memory.
/// The cells are judged, not the files written from them; of those, the limit of bytes is judged.
void judge_cells(Assertions assertions, const SceneLimits& limits, Severity severity, const CellFlow& flow,
                 Context& context);

} // namespace facetmill::validate_stage
