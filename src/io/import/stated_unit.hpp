#pragma once
// The length unit that a CAD file states. It is known before the conversion, because lengths of the pipeline
// are resolved by it.

#include "mesh/scene.hpp"

#include <string_view>

namespace facetmill::io::import {

/// The unit of the first context of a STEP file (ISO 10303-41), or unknown.
[[nodiscard]] Unit unit_of_step(std::string_view file);
/// The unit flag in the global section of an IGES file (IGES 5.3, 2.2.4.3.14), or unknown.
[[nodiscard]] Unit unit_of_iges(std::string_view file);

} // namespace facetmill::io::import
