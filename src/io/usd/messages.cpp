#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages usd_messages{
    {"E-USDZ",
     "USDZ holds only PNG and JPEG, and a texture of the scene cannot be converted to them. Or a USDZ file "
     "is malformed or from another program: facetmill reads only its own.",
     "To write, convert the textures to PNG or JPEG, or write .glb. To read, export the model as glTF "
     "(.glb).",
     {ErrorKind::stage, ErrorKind::malformed}},
};

} // namespace facetmill
