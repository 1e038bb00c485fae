#pragma once
// The cost of drawing a file: draw calls and pixels of images.

#include "io/bytes.hpp"

#include <cstdint>
#include <string>

namespace facetmill::io {

struct DrawCosts {
    std::uint64_t draw_calls = 0; ///< of glTF: the primitives of all nodes
    std::uint64_t pixels = 0;     ///< of the PNG, JPEG and WebP images in the file
};

/// The costs of a GLB, a glTF or an image; 0 for other and broken files.
[[nodiscard]] DrawCosts draw_costs(const std::string& name, Span bytes);

} // namespace facetmill::io
