#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages wrap_messages{
    {"E-WRAP", "A wrap could not be made, or a test of its guarantees failed.",
     "Use a larger `offset`. If the coordinates are far from the origin, move the part there with "
     "`transform` first.",
     ErrorKind::stage},
    {"E-WRAP-LARGE", "A wrap would have too many faces.", "Use a larger `alpha`, or raise `max_faces`.",
     ErrorKind::limit},
};

} // namespace facetmill
