#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages textures_messages{
    {"W-TEXTURE-KEPT",
     "`textures` leaves an image unchanged, or in its format. The image is broken, larger than 2^26 pixels "
     "or of an unsupported kind, or it uses alpha, which JPEG cannot store.",
     "Use `format: webp` or `png` for images that use alpha. Scale images of more than 8192 x 8192 pixels "
     "down with another program."},
};

} // namespace facetmill
