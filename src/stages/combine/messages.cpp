#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages combine_messages{
    {"E-COMBINE",
     "`combine` cannot process a part that is open, has no faces, is inside out or is flattened by its node. "
     "It also fails if rounding would cause intersections, or if too many faces intersect for the available "
     "memory.",
     "Close the part with `clean: {holes: minimal}` and turn it outward with `orient`. The message names the "
     "part. To use less memory, combine fewer parts at a time.",
     ErrorKind::stage},
    {"W-COMBINE-IDLE", "A part of `with` removes nothing in `combine`.",
     "Move the part so that it meets the others (`transform: {only: NAME, translate: [0, 0, 1]}`), or leave "
     "it out of `with`. `facetmill info` prints the bounds."},
    {"W-COMBINE-NOTHING", "`combine` removes all faces of a part.",
     "For an intersection, use parts that overlap. For a difference, use parts that do not cover it. "
     "`facetmill info` prints the bounds."},
};

} // namespace facetmill
