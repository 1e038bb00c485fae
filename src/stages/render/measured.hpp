#pragma once
// Attributes that the scene lacks and that render measures to draw them.

#include "geometry/quantities/quantities.hpp"
#include "stages/render/options.hpp"

#include <memory>

namespace facetmill::render_stage {

/// The quantity to measure. Null if no attribute is requested, or if the scene or the other scene has it.
/// Throws a stage error (E-ATTRIBUTE) if the attribute neither exists nor can be measured.
[[nodiscard]] const Quantity* quantity_to_measure(const RenderOptions& o, const Scene& scene,
                                                  const Scene* other, const Context& context);

/// Whether the attribute compares with the scene as loaded.
bool is_from_load(const RenderOptions& o);

/// The unit of the legend. Throws a usage error (E-UNIT) if the requested unit differs from the numbers'
/// unit.
[[nodiscard]] std::string unit_of_legend(const RenderOptions& o, const Quantity* quantity, Unit unit,
                                         const Context& context);

/// The selected parts with the measured numbers as an attribute. A quantity that compares is measured
/// against `other`. bind: the scene is skinned or morphed. It is measured in bind pose, and its faces are
/// not split, so that it can be posed. For deviation, large faces are cut into small faces, unless their
/// edges are drawn.
[[nodiscard]] Scene measured(const RenderOptions& o, const Quantity& quantity, const Scene& scene,
                             const std::function<bool(const Part&)>& selects, const FaceTree* other,
                             bool bind);

} // namespace facetmill::render_stage
