#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages tile_messages{
    {"E-TILE",
     "The tile size is 0, there are too many tiles, or a part cannot get pegs.",
     "Choose a larger size. Pegs need a closed part and must be shorter than a tile.",
     {ErrorKind::limit, ErrorKind::stage, ErrorKind::usage}},
};

} // namespace facetmill
