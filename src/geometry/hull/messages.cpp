#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages hull_messages{
    {"E-HULL",
     "No convex shape can be made around a part. Its points are on a line, its node scales axes differently, "
     "or rounding is too coarse.",
     "Exclude the part with `only: [\"!NAME\"]`, or use `transform: {bake: true}` if its node scales axes "
     "differently.",
     ErrorKind::stage},
};

} // namespace facetmill
