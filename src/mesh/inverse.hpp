#pragma once
// The way back.

#include "base/vec.hpp"

#include <optional>

namespace facetmill {

/// The inverse of an affine map; none when it is singular.
std::optional<Transform> inverse(const Transform& t);

} // namespace facetmill
