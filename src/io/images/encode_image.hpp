#pragma once
// Pixels as image files.

#include "io/images/pixels.hpp"

namespace facetmill::io {

/// How an image loses what cannot be seen.
struct LossSettings {
    int quality = 80;        ///< 1 to 100, as the libraries have it
    bool lossless = false;   ///< WebP only
    bool as_numbers = false; ///< not for eyes: no chroma at half the size (JPEG), or the best there is (WebP)
};

/// A PNG of as few channels as the image needs. Throws limit (E-MEMORY), as all of these do.
[[nodiscard]] Bytes encoded_png(const Pixels& image);
/// A PNG of three channels, or four where one is not opaque, also where all is grey.
[[nodiscard]] Bytes encoded_png_in_colour(const Pixels& image);
/// A progressive JPEG without the alpha; of one channel where all is grey.
[[nodiscard]] Bytes encoded_jpeg(const Pixels& image, const LossSettings& settings);
/// A WebP, whose colours are kept where nothing is to be seen of them. Its sides are at most 16383 pixels
/// long.
[[nodiscard]] Bytes encoded_webp(const Pixels& image, const LossSettings& settings);

/// A PNG or JPEG with the same pixels in fewer bytes: JPEG with the same coefficients and all its markers, in
/// the best Huffman tables, progressive where that is smaller; PNG as encoded_png makes it, without what it
/// says beside the pixels. Empty where nothing is gained, for PNG of 16 bits a channel, other kinds of files,
/// and what is broken. Images have at most 2^26 pixels.
[[nodiscard]] Bytes repacked_image(Span bytes);

/// Whether all pixels are opaque.
bool is_opaque(const Pixels& image);

} // namespace facetmill::io
