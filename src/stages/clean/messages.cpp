#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages clean_messages{
    {"W-CLEAN", "`clean` could not do some repairs, so the mesh is unchanged in those places.",
     "Check the positions in the message, and try other options of `clean`."},
};

} // namespace facetmill
