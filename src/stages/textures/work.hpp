#pragma once
// What textures does to one image.

#include "io/gltf/contents/textures.hpp"
#include "stages/textures/options.hpp"

namespace facetmill::textures_stage {

/// An image as a file says it.
struct ImageState {
    std::string format; ///< "png", "jpeg", "webp", "ktx2", "dds"; empty for others
    std::size_t width = 0, height = 0, bytes = 0;
};

struct ProcessedImage {
    ImageState before, after;
    io::Bytes bytes;   ///< empty: the image stays as it is
    std::string why;   ///< it stays, where anything was asked of it; else empty
    bool warn = false; ///< that is not what was asked for
};

/// What its format and size are, of which the header is read.
ImageState state_of(const io::Bytes& bytes);

/// The image, whose state_of is `before`, scaled and written as the options of its role say, or why it stays.
ProcessedImage processed_image(const io::Bytes& bytes, const ImageState& before, const io::ImageUse& use,
                               const TexturesOptions& o);

} // namespace facetmill::textures_stage
