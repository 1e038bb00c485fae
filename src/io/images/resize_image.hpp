#pragma once
// Images made smaller.

#include "io/images/pixels.hpp"

namespace facetmill::io {

/// What the numbers of an image say, which decides how its pixels are mixed.
enum class PixelKind {
    colours, ///< in sRGB: mixed in linear light
    normals, ///< directions, each coordinate from -1 to 1: mixed, and of length 1 again
    numbers  ///< anything else: mixed as they are
};

/// The image at width x height, neither larger than before nor 0, by Lanczos's filter of three lobes
/// (Turkowski, "Filters for Common Resampling Tasks", 1990), which ends at the borders. Alpha is mixed as a
/// number. With coverage, colours are weighted by alpha; where the result cannot be seen at all, they are the
/// plain mean, so that its neighbours are not darkened when a texture is magnified. The same for any number
/// of threads.
[[nodiscard]] Pixels resized_image(const Pixels& image, std::size_t width, std::size_t height, PixelKind kind,
                                   bool coverage);

} // namespace facetmill::io
