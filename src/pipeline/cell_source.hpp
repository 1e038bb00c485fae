#pragma once
// The first steps of a run for a mesh larger than memory.

#include "pipeline/engine.hpp"

namespace facetmill::pipeline {

/// Runs the steps that work on cells. Returns true if the scene is in memory afterwards; false after a
/// failure, or when all steps worked on cells.
bool run_on_cells(Engine& engine, const CellPlan& plan, SceneState& flow);

} // namespace facetmill::pipeline
