#pragma once
// The unit of a scene in messages.

#include "mesh/scene.hpp"

namespace facetmill {

/// The unit to print after a length: "mm", or "scene units" if unknown.
[[nodiscard]] inline const char* unit_text(Unit unit) {
    return unit == Unit::unknown ? "scene units" : to_string(unit);
}

} // namespace facetmill
