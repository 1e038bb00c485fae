#pragma once
// The options of textures.

#include "stage/stage.hpp"

namespace facetmill::textures_stage {

enum class Format { keep, png, jpeg, webp, avif, ktx2 };
/// The format's name in options: "png".
[[nodiscard]] std::string name_of(Format format);

/// The requested options for images of a role.
struct RoleOptions {
    std::optional<std::int64_t> max_size, quality;
    std::optional<bool> power_of_two, lossless;
    std::optional<Format> format;
};

struct TexturesOptions {
    std::optional<std::int64_t> max_size, quality;
    bool power_of_two = false, lossless = false, repack = false, atlas = false;
    Format format = Format::keep;
    std::int64_t gutter = 8, unroll = 4;
    std::int64_t timeout = 600; ///< time limit for a KTX2 image, in seconds
    RoleOptions normals, data;
};

/// The settings for images of a role.
struct ImageSettings {
    std::size_t max_size = SIZE_MAX;
    bool power_of_two = false, lossless = false;
    Format format = Format::keep;
    int quality = 80;
};
[[nodiscard]] ImageSettings for_colours(const TexturesOptions& o);
[[nodiscard]] ImageSettings for_normals(const TexturesOptions& o);
[[nodiscard]] ImageSettings for_data(const TexturesOptions& o);

void declare_textures(Declare<TexturesOptions>& d);
/// Whether any role is to be encoded in the format.
bool wants(const TexturesOptions& o, Format format);

/// Checks that lossless has WebP or AVIF, and that AVIF and KTX2 have an encoder, which the declaration
/// cannot express.
void verify_textures(const TexturesOptions& o, const Value& given, Problems& problems);

} // namespace facetmill::textures_stage
