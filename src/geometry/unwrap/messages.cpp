#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages unwrap_messages{
    {"E-UNWRAP-FULL", "The charts of `unwrap` do not fit into the texture with their gutters.",
     "Use a larger `texture`, a smaller `gutter`, or fewer `texels_per_m`. If the mesh has many components, "
     "join its vertices with `clean` first.",
     ErrorKind::limit},
    {"E-UNWRAP-FINE", "The faces are too small for texture coordinates in float32.",
     "Remove tiny faces with `clean` or `simplify` first, or unwrap fewer parts at once with `only`.",
     ErrorKind::limit},
};

} // namespace facetmill
