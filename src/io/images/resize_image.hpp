#pragma once
// Scales images down.

#include "io/images/pixels.hpp"

namespace facetmill::io {

/// The meaning of an image's numbers, which determines how pixels are mixed.
enum class PixelKind {
    colours, ///< sRGB colours, mixed in linear light
    normals, ///< directions with coordinates from -1 to 1, mixed, then normalised
    numbers  ///< other data, mixed without conversion
};

/// The image scaled to width x height, which must not be 0 or larger than before. Uses Lanczos's filter with
/// three lobes (K. Turkowski, "Filters for Common Resampling Tasks", 1990), cut off at the borders. Alpha is
/// mixed as a number. With coverage, colours are weighted by alpha. Fully transparent results get the plain
/// mean, so that magnified textures have no dark fringes. The result does not depend on the number of
/// threads.
[[nodiscard]] Pixels resized_image(const Pixels& image, std::size_t width, std::size_t height, PixelKind kind,
                                   bool coverage);

} // namespace facetmill::io
