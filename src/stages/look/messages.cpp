#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages look_messages{
    {"E-LOOK", "`look` has no scene to compare with.", "Load a mesh before, or give one as `with`.",
     ErrorKind::stage},
};

} // namespace facetmill
