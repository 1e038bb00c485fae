#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages usd_messages{
    {"E-USDZ",
     "USDZ cannot hold a texture of the scene: it holds only PNG and JPEG, and facetmill converts WebP and "
     "AVIF. Or a USDZ file is malformed, or another program wrote it: facetmill reads only its own files.",
     "To write, give textures as PNG or JPEG, or write .glb. To read, export the model as glTF (.glb).",
     {ErrorKind::stage, ErrorKind::malformed}},
};

} // namespace facetmill
