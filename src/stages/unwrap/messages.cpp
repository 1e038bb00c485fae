#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages unwrap_stage_messages{
    {"W-UNWRAP-TEXTURES", "`unwrap` replaced texture coordinates that textures of materials still use.",
     "Use `keep: true` so that textures refer to the old coordinates, or make new textures for the new "
     "ones."},
};

} // namespace facetmill
