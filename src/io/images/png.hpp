#pragma once
// Encodes pictures as PNG files, and as text inside a page.

#include "geometry/render/render.hpp"
#include "io/bytes.hpp"

namespace facetmill::io {

enum class PngEffort {
    small,
    fast ///< a sixth of the time for an eighth more bytes
};

/// A PNG of 8 bits a channel with alpha. Throws a limit error (E-MEMORY) when zlib has no memory.
[[nodiscard]] Bytes png(const Picture& picture, PngEffort effort = PngEffort::small);

/// The bytes in base64 (RFC 4648, with padding).
[[nodiscard]] std::string base64(Span bytes);

} // namespace facetmill::io
