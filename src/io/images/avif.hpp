#pragma once
// AVIF images, through libavif if the build has it (FACETMILL_AVIF).

#include "io/images/encode_image.hpp"

#include <string>

namespace facetmill::io {

/// True if this build reads and writes AVIF.
[[nodiscard]] bool has_avif();

/// True if the file begins like an AVIF image (AV1 Image File Format, section 6).
[[nodiscard]] bool is_avif(Span bytes);
/// True if all boxes of the file are complete.
[[nodiscard]] bool avif_ends(Span bytes);

/// Decodes an AVIF as decoded_image does; none without libavif, for broken files, and for images that a
/// transformation property turns, mirrors or crops. header: reads only the size.
[[nodiscard]] std::optional<Pixels> decoded_avif(Span bytes, bool header);
/// An AVIF. Call it only with has_avif(). Throws a stage error (E-AVIF).
[[nodiscard]] Bytes encoded_avif(const Pixels& image, const LossSettings& settings);

} // namespace facetmill::io
