#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages off_messages{
    {"E-OFF", "An OFF file is malformed or truncated.",
     "Correct the line given in the message, or export the file again.", ErrorKind::malformed},
};

} // namespace facetmill
