#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages tile_messages{
    {"W-TILE-NOTHING", "A part has no faces, so it gives no tile.",
     "Exclude the part with `only`, or ignore this warning."},
    {"W-TILE-PEGS",
     "Two neighbouring tiles have no peg, because the solid is too thin where they meet, or other pegs are "
     "too near.",
     "Use a smaller `diameter`, `length` or `wall` of `pegs`, or glue these tiles."},
};

} // namespace facetmill
