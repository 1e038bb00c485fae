#pragma once
// The first steps of a run on a mesh that is larger than memory.

#include "pipeline/engine.hpp"

namespace facetmill::pipeline {

/// Runs the steps of the engine's plan that work on cells; the scene of the flow is in memory afterwards.
/// False after a failure, and when all steps were done on cells.
bool run_on_cells(Engine& engine, const CellPlan& plan, SceneState& flow);

} // namespace facetmill::pipeline
