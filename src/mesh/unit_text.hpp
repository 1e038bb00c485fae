#pragma once
// The unit of a scene in messages.

#include "mesh/scene.hpp"

namespace facetmill {

/// Behind a length: "mm", or "scene units" where none is known.
inline const char* unit_text(Unit unit) { return unit == Unit::unknown ? "scene units" : to_string(unit); }

} // namespace facetmill
