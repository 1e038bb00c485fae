#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages normals_messages{
    {"W-NO-TANGENTS", "A part got no tangents, because it has no normals or lacks the texture coordinates.",
     "Set `tangents` to the number of texture coordinates that the part has: 0 for TEXCOORD_0. If it has no "
     "normals, use `method: smooth`."},
};

} // namespace facetmill
