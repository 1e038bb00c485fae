#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages tile_messages{
    {"W-TILE-NOTHING", "A part has no faces, so it gives no tile.",
     "Exclude the part with `only`, or ignore this warning."},
};

} // namespace facetmill
