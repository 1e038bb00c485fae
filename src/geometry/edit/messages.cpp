#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages edit_messages{
    {"E-MASK", "A mask uses an attribute that a part does not have.",
     "Run `facetmill info` to list the attributes.", ErrorKind::stage},
};

} // namespace facetmill
