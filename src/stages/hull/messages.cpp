#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages hull_stage_messages{
    {"W-HULL-FLAT", "A part is flat, so its hull has no volume.",
     "Give it a thickness with `thicken` before `hull`, or exclude it with `only`."},
};

} // namespace facetmill
