#pragma once
// Encodes pixels as image files.

#include "io/images/pixels.hpp"

namespace facetmill::io {

/// Settings for encoding with loss.
struct LossSettings {
    int quality = 80;        ///< 1 to 100, as in the libraries
    bool lossless = false;   ///< WebP and AVIF only
    bool as_numbers = false; ///< data instead of colours: no chroma subsampling (JPEG), or the best chroma
                             ///< conversion (WebP, AVIF)
};

/// A PNG with as few channels as the image needs. Throws a limit error (E-MEMORY), as all these functions
/// do.
[[nodiscard]] Bytes encoded_png(const Pixels& image);
/// The same, in a fifth of the time with a few percent more bytes.
[[nodiscard]] Bytes encoded_png_quickly(const Pixels& image);
/// A square PNG of 16 bits a channel, grey or with three colours. levels: side * side * channels.
[[nodiscard]] Bytes encoded_png_16(const std::vector<std::uint16_t>& levels, std::size_t side,
                                   std::size_t channels);
/// A PNG with three channels, or four if any pixel is transparent, even if all pixels are grey.
[[nodiscard]] Bytes encoded_png_in_colour(const Pixels& image);
/// A progressive JPEG without alpha. It has a single channel if all pixels are grey.
[[nodiscard]] Bytes encoded_jpeg(const Pixels& image, const LossSettings& settings);
/// A WebP. Keeps the colours of fully transparent pixels. Each side is at most 16383 pixels long.
[[nodiscard]] Bytes encoded_webp(const Pixels& image, const LossSettings& settings);

/// A PNG or JPEG with the same pixels in fewer bytes. A JPEG keeps its coefficients and markers, gets
/// optimal Huffman tables, and is progressive if that is smaller. A PNG is encoded by encoded_png and loses
/// its metadata. Returns no bytes without a gain, and for PNG with 16 bits a channel, other formats and
/// broken files. Images have at most 2^26 pixels.
[[nodiscard]] Bytes repacked_image(Span bytes);

/// Whether all pixels are opaque.
bool is_opaque(const Pixels& image);

} // namespace facetmill::io
