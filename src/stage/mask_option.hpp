#pragma once
// The option `mask` of the shaping stages.

#include "geometry/mask.hpp"
#include "options/declaration.hpp"

namespace facetmill {

/// The group's fields, for Declare::group.
void declare_mask(Declare<MaskSettings>& d);

/// Its help.
inline constexpr const char* mask_help =
    "Which vertices move, and what share of the way: those whose faces all have the material and the group, "
    "times the attribute.";

} // namespace facetmill
