#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages tileset_messages{
    {"E-TILESET",
     "facetmill cannot read this 3D Tiles tileset. It has a nested tileset, a required extension, content "
     "other than GLB, or a broken subtree file of an implicit tiling.",
     "Load the files of its tiles one by one. facetmill reads explicit and implicit tilesets of GLB files.",
     ErrorKind::malformed},
};

} // namespace facetmill
