#pragma once
// Converts between sRGB bytes (IEC 61966-2-1, 1999) and linear light, by tables.

#include <cstdint>

namespace facetmill {

/// The linear light, from 0 to 1, of an sRGB byte.
[[nodiscard]] float linear_of(std::uint8_t encoded);
/// The sRGB byte nearest to linear light. Values below 0 or above 1 are clamped, and NaN gives 0.
[[nodiscard]] std::uint8_t srgb_of(float linear);

/// The same for fractions of any precision. Fractions outside 0 to 1 follow the formula, and NaN stays NaN.
[[nodiscard]] double linear_fraction(double encoded);
[[nodiscard]] double srgb_fraction(double linear);

} // namespace facetmill
