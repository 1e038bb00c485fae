#pragma once
// What is asked of a scene before a stage works on it and after it has.

#include "pipeline/scene_state.hpp"
#include "stage/context.hpp"

namespace facetmill::pipeline {

/// "their names: a, b", of all parts.
std::string names_hint(const Scene& scene);
/// Warns (W-ONLY) where the step's `only` selects none of the parts.
void warn_of_empty_selection(const Step& step, const Scene& scene, Context& context);

/// Files with other numbers are refused; stages make them of very large ones. Throws stage, E-RANGE.
void require_finite(const Scene& scene);

/// Throws bug, E-INVARIANT, where the stage broke an invariant of scenes.
void check_invariants(const Step& step, const Scene& scene);
/// The same where the scene is no longer what the stage before the step left, as far as that is known.
void check_left(const Step& step, const SceneState::Left& left, const Scene& scene);

} // namespace facetmill::pipeline
