#pragma once
// Checks of the scene before and after each stage.

#include "pipeline/scene_state.hpp"
#include "stage/context.hpp"

namespace facetmill::pipeline {

/// "their names: a, b", of all parts.
[[nodiscard]] std::string names_hint(const Scene& scene);
/// Warns (W-ONLY) if the step's `only` selects no part.
void warn_of_empty_selection(const Step& step, const Scene& scene, Context& context);

/// Throws stage, E-RANGE for NaN and infinite numbers. Readers refuse them, but stages produce them from very
/// large numbers.
void require_finite(const Scene& scene);

/// Throws bug, E-INVARIANT, if the stage broke an invariant of scenes.
void check_invariants(const Step& step, const Scene& scene);
/// The same if the scene differs from the scene that the previous stage left, as far as that is known.
void check_left(const Step& step, const SceneState::Left& left, const Scene& scene);

} // namespace facetmill::pipeline
