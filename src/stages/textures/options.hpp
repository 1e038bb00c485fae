#pragma once
// The options of textures.

#include "stage/stage.hpp"

namespace facetmill::textures_stage {

enum class Format { keep, png, jpeg, webp, ktx2 };
/// The word of the option: "png".
std::string name_of(Format format);

/// What is asked of images of one role.
struct RoleOptions {
    std::optional<std::int64_t> max_size, quality;
    std::optional<bool> power_of_two, lossless;
    std::optional<Format> format;
};

struct TexturesOptions {
    std::optional<std::int64_t> max_size, quality;
    bool power_of_two = false, lossless = false, repack = false;
    Format format = Format::keep;
    std::int64_t timeout = 600; ///< seconds for one KTX2 image
    RoleOptions normals, data;
};

/// What is done to images of a role.
struct ImageSettings {
    std::size_t max_size = SIZE_MAX;
    bool power_of_two = false, lossless = false;
    Format format = Format::keep;
    int quality = 80;
};
ImageSettings for_colours(const TexturesOptions& o);
ImageSettings for_normals(const TexturesOptions& o);
ImageSettings for_data(const TexturesOptions& o);

void declare_textures(Declare<TexturesOptions>& d);
/// Whether images of some role are to be KTX2.
bool wants_ktx2(const TexturesOptions& o);

/// lossless goes with WebP only, and KTX2 with a program that is there.
void verify_textures(const TexturesOptions& o, const Value& given, Problems& problems);

} // namespace facetmill::textures_stage
