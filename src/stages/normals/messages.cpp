#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages normals_messages{
    {"W-NO-TANGENTS", "A part got no tangents, because it has no normals or lacks the texture coordinates.",
     "Give the number of existing texture coordinates. With `normals: keep`, choose another method if the "
     "part "
     "has no normals."},
};

} // namespace facetmill
