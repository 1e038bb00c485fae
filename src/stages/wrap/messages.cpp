#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages wrap_stage_messages{
    {"E-WRAP-LARGE", "A wrap would have too many faces.", "Use a larger `alpha`, or raise `max_faces`.",
     ErrorKind::limit},
};

} // namespace facetmill
