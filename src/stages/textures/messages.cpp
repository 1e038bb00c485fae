#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages textures_messages{
    {"W-TEXTURE-KEPT",
     "`textures` leaves an image unchanged, or in its format. The image is broken, larger than 2^26 pixels "
     "or of an unsupported kind, or it uses alpha, which JPEG cannot store.",
     "Use `format: webp` or `png` for images that use alpha. Scale images of more than 8192 x 8192 pixels "
     "down with another program."},
    {"W-TEXTURE-ATLAS",
     "`textures: {atlas: true}` scaled textures down, because the atlas would be larger than max_size. It "
     "halves the texture with the most texels per area of its faces first.",
     "Use a larger `max_size`, up to 16384, if your devices support such textures."},
};

} // namespace facetmill
