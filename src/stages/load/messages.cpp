#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages load_messages{
    {"E-LINES", "The lines of a file cannot get the requested thickness.", "Give `lines` in scene units.",
     ErrorKind::stage},
};

} // namespace facetmill
