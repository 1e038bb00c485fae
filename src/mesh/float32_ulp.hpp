#pragma once
// The distance between 32-bit floats at a mesh's coordinates.

#include "base/math/vec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace facetmill {

/// A float32 ulp of the largest coordinate of the bounds. 0 for an empty box, and for a point at the origin.
[[nodiscard]] inline double float32_ulp(const Box& bounds) {
    if (bounds.empty()) return 0;
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        largest = std::max({largest, std::fabs(bounds.min[i]), std::fabs(bounds.max[i])});
    constexpr double least = std::numeric_limits<float>::denorm_min();
    return largest > 0 ? std::max(std::ldexp(1.0, std::ilogb(largest) - 23), least) : 0;
}

} // namespace facetmill
