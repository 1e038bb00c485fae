#pragma once
// Detects images that no viewer can show, from their header and length only.

#include "base/error.hpp"
#include "io/bytes.hpp"

#include <string>

namespace facetmill::io {

/// The fault of an image file that can be found without decoding: "its header is broken", "its data end
/// early", "it is of no known kind". Empty without a fault. Supports PNG, JPEG, WebP, AVIF, KTX2 and DDS.
/// Does not check the data between the header and the end.
[[nodiscard]] std::string image_fault(Span bytes);

/// The warning (W-IMAGE) for such an image that is written unchanged.
[[nodiscard]] Diagnostic warning_of_fault(const std::string& image, const std::string& fault);

} // namespace facetmill::io
