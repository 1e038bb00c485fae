#pragma once
// Fills texels without a point of the surface.

#include <cstdint>
#include <vector>

namespace facetmill::baking {

/// For each texel: itself if covered, otherwise the nearest covered texel within `reach` (ties: the upper,
/// then the left one), otherwise UINT32_MAX. O(texels reach), parallel.
[[nodiscard]] std::vector<std::uint32_t> nearest_covered(const std::vector<std::uint8_t>& covered, int size,
                                                         int reach);

} // namespace facetmill::baking
