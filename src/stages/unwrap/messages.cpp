#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages unwrap_stage_messages{
    {"E-UNWRAP-SET", "A set of texture coordinates of `unwrap` would leave a gap. glTF numbers sets from 0.",
     "Unwrap the lower set first, or use its number.", ErrorKind::usage},
    {"W-UNWRAP-TEXTURES", "`unwrap` replaced texture coordinates that textures of materials still use.",
     "Use `keep: true` so that textures refer to the old coordinates, or make new textures for the new "
     "ones."},
};

} // namespace facetmill
