#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages ply_messages{
    {"E-PLY", "A PLY file is malformed or truncated.",
     "Export the file again. The message names the element or line.", ErrorKind::malformed},
};

} // namespace facetmill
