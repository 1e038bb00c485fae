#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages mesh_messages{
    {"E-LIMIT",
     "A scene or the result of a stage has more vertices, corners, faces or lines than facetmill supports.",
     "Simplify first, use fewer parts, or request less.", ErrorKind::limit},
    {"E-PLANE", "A plane has no direction, or its numbers are not finite.",
     "Write for example `plane: z=0` or `plane: {normal: [0, 0, 1], through: centre}`.", ErrorKind::usage},
};

} // namespace facetmill
