#pragma once
// Attributes that a scene has not, and that render measures in order to draw them.

#include "geometry/quantities/quantities.hpp"
#include "stages/render/options.hpp"

#include <memory>

namespace facetmill::render_stage {

/// What is measured; null: the attribute that is asked for is one of the scene, or of the other, or none is.
/// Throws stage (E-ATTRIBUTE) where it is neither there nor one that can be measured.
const Quantity* quantity_to_measure(const RenderOptions& o, const Scene& scene, const Scene* other,
                                    const Context& context);

/// Whether the attribute is from the scene as loaded.
bool is_from_load(const RenderOptions& o);

/// What the unit of the legend is. Throws usage (E-UNIT) where another is given than the numbers have.
std::string unit_of_legend(const RenderOptions& o, const Quantity* quantity, Unit unit,
                           const Context& context);

/// The selected parts with their numbers as an attribute: of what compares, from the surface behind `other`.
/// bind: the scene is skinned or morphed: it is measured as stages see it, and stays in one piece, to be
/// posed. Of deviation large faces are cut into small ones, unless their edges are to be drawn.
Scene measured(const RenderOptions& o, const Quantity& quantity, const Scene& scene,
               const std::function<bool(const Part&)>& selects, const FaceTree* other, bool bind);

} // namespace facetmill::render_stage
