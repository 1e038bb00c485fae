#pragma once
// Hatching as users ask for it.

#include "geometry/section/section.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

struct HatchOption {
    Length spacing = Length::percent(1);
    Angle angle = Angle::degrees(45);
    polygon::Keep keep = polygon::Keep::inside;
};

/// Declares spacing (primary), angle and keep.
void declare_hatch(Declare<HatchOption>& d);

/// The lines for a scene: each section of a stack gets the same ones. Throws stage (E-HATCH) for a spacing
/// that comes to 0.
polygon::HatchSettings resolve_hatch(const HatchOption& option, const Scene& scene, Context& context);

} // namespace facetmill
