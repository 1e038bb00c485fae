#pragma once
// Images that no viewer will show, told by their header and their extent alone.

#include "base/error.hpp"
#include "io/bytes.hpp"

#include <string>

namespace facetmill::io {

/// What is wrong with an image file as far as that is seen without decoding it: "its header is broken", "its
/// data end early", "it is of no known kind"; empty where nothing is. PNG, JPEG, WebP, KTX2 and DDS. What
/// lies between the header and the end is not looked at.
[[nodiscard]] std::string image_fault(Span bytes);

/// What is said (W-IMAGE) where such an image is written as it is.
[[nodiscard]] Diagnostic warning_of_fault(const std::string& image, const std::string& fault);

} // namespace facetmill::io
