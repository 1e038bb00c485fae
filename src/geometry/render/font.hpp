#pragma once
// Letters of five by seven pixels, for the numbers in pictures.

#include "base/text/words.hpp"
#include "geometry/render/render.hpp"

#include <algorithm>
#include <string_view>

namespace facetmill {

inline constexpr int letter_width = 6, letter_height = 7; ///< in pixels, including the gap after a letter

/// The bytes of the UTF-8 character at i; 1 if it is invalid.
[[nodiscard]] inline std::size_t character_length(std::string_view text, std::size_t i) {
    return std::max<std::size_t>(1, utf8_length(text, i));
}

/// Writes the text with its upper left corner at (x, y). Each pixel of a letter becomes a square of `scale`
/// pixels. Text that does not fit is cut off. UTF-8: each character beyond ASCII is a box, and so is each
/// invalid byte.
void write_text(Picture& picture, int x, int y, int scale, std::string_view text,
                const std::array<std::uint8_t, 3>& colour);

} // namespace facetmill
