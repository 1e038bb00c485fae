#pragma once
// Decodes images, and combines channels for glTF textures that arrange them differently.

#include "io/bytes.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace facetmill::io {

/// Red, green, blue and alpha with 8 bits each, row by row from the top. Values are as in the file.
struct Pixels {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    bool damaged = false; ///< a JPEG with truncated or broken data: the library guessed the rest

    /// The nearest pixel at (x, y) of the image scaled to width x height.
    const std::uint8_t* at(std::size_t x, std::size_t y, std::size_t of_width, std::size_t of_height) const {
        return &rgba[4 * (y * height / of_height * width + x * width / of_width)];
    }
};

/// The maximum number of pixels to decode.
constexpr std::size_t max_pixels = std::size_t{1} << 26;

/// Decodes a PNG, JPEG, WebP or (with libavif) AVIF of at most max_pixels; none for other formats and broken
/// files. Grey becomes three equal channels, missing alpha is opaque, and 16 bits are rounded to 8. Colours
/// are the file's numbers, without gAMA and iCCP, as glTF requires. Also none for a JPEG of more than 500
/// scans, because each scan costs as much as a whole image.
[[nodiscard]] std::optional<Pixels> decoded_image(Span bytes);

/// The width and height of such an image. Reads only the header; none if the header is broken.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> image_size(Span bytes);

/// Whether all pixels are grey.
bool is_grey(const Pixels& image);

/// The source of a channel of a combined image: an image's channel (0 to 3) or brightness (4), otherwise a
/// constant.
struct Channel {
    const Pixels* image = nullptr;
    int channel = 0;
    std::uint8_t number = 255;
};
constexpr int brightness = 4; ///< 0.299 red + 0.587 green + 0.114 blue (ITU-R BT.601)

/// A PNG as large as the largest source image. Smaller images are scaled up.
[[nodiscard]] Bytes combined_image(const std::array<Channel, 4>& channels);

/// A PNG with the normals of a height map: slopes are `strength` times the brightness difference of the
/// neighbours. The image repeats at its borders. Source: J. F. Blinn, "Simulation of Wrinkled Surfaces",
/// 1978.
[[nodiscard]] Bytes normals_of_relief(const Pixels& relief, double strength);

} // namespace facetmill::io
