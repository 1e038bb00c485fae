#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages separate_messages{
    {"E-GROUP", "The mesh has no face attribute that numbers groups.",
     "Create the attribute `group` with `merge`. Run `facetmill info` to list the attributes.",
     ErrorKind::stage},
    {"E-PARTS", "The result would have more parts than allowed.",
     "Remove small components first, or raise the limit.", ErrorKind::stage},
};

} // namespace facetmill
