#pragma once
// Checks of the scene before and after each stage.

#include "pipeline/scene_state.hpp"
#include "stage/context.hpp"

namespace facetmill::pipeline {

/// A hint with the names of all parts: "their names: a, b".
[[nodiscard]] std::string names_hint(const Scene& scene);
/// Warns (W-ONLY) if the step's `only` selects no part.
void warn_of_empty_selection(const Step& step, const Scene& scene, Context& context);

/// Throws a stage error (E-RANGE) for NaN and infinite numbers. Readers refuse them, but stages produce them
/// from very large numbers.
void require_finite(const Scene& scene);

/// Throws a bug error (E-INVARIANT) if the stage broke an invariant of scenes.
void check_invariants(const Step& step, const Scene& scene);
/// Checks invariants if the scene differs, as far as known, from the scene that the previous stage left.
void check_left(const Step& step, const SceneState::Left& left, const Scene& scene);

} // namespace facetmill::pipeline
