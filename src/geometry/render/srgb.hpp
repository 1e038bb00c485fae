#pragma once
// The curve of sRGB (IEC 61966-2-1, 1999), by tables: bytes to linear light and back.

#include <cstdint>

namespace facetmill {

/// Linear light, 0 to 1, of a byte in sRGB.
[[nodiscard]] float linear_of(std::uint8_t encoded);
/// The byte of sRGB nearest to linear light; values below 0 or above 1 are clamped, NaN gives 0.
[[nodiscard]] std::uint8_t srgb_of(float linear);

} // namespace facetmill
