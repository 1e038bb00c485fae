#pragma once
// Processes a single image for textures.

#include "io/gltf/contents/textures.hpp"
#include "stages/textures/options.hpp"

namespace facetmill::textures_stage {

/// The properties of an image file.
struct ImageState {
    std::string format; ///< "png", "jpeg", "webp", "avif", "ktx2", "dds"; empty for others
    std::size_t width = 0, height = 0, bytes = 0;
};

struct ProcessedImage {
    ImageState before, after;
    io::Bytes bytes;   ///< empty: the image stays unchanged
    std::string why;   ///< the reason, if an image with options stays unchanged; otherwise empty
    bool warn = false; ///< the result differs from the request
};

/// Reads format and size from the header.
[[nodiscard]] ImageState state_of(const io::Bytes& bytes);

/// The image, scaled and encoded by the options of its role, or the reason to keep it. before: its state_of.
[[nodiscard]] ProcessedImage processed_image(const io::Bytes& bytes, const ImageState& before,
                                             const io::ImageUse& use, const TexturesOptions& o);

} // namespace facetmill::textures_stage
