#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages tile_messages{
    {"E-TILE",
     "The tile size is 0, or it gives too many tiles.",
     "Choose a larger size.",
     {ErrorKind::limit, ErrorKind::stage, ErrorKind::usage}},
};

} // namespace facetmill
