#pragma once
// Letters of five by seven pixels, for the numbers in pictures.

#include "geometry/render/render.hpp"

#include <string_view>

namespace facetmill {

inline constexpr int letter_width = 6, letter_height = 7; ///< pixels, the gap after a letter included

/// Writes the text with its upper left corner at (x, y), each pixel of a letter a square of `scale` pixels;
/// what does not fit is cut off. ASCII; other bytes are boxes.
void write_text(Picture& picture, int x, int y, int scale, std::string_view text,
                const std::array<std::uint8_t, 3>& colour);

} // namespace facetmill
