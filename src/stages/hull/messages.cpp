#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages hull_messages{
    {"E-HULL", "A part has no convex hull.",
     "Exclude the part with `only` if all of its points are on a line, or give its faces a thickness with "
     "`thicken`."},
    {"W-HULL-FLAT", "A part is flat, so its hull has no volume.",
     "Give it a thickness with `thicken` before `hull`, or exclude it with `only`."},
};

} // namespace facetmill
