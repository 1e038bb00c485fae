#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages clip_messages{
    {"W-CLIP-ALL", "The planes of `clip` cut no part, so the whole scene is kept.",
     "Check the plane. Run `facetmill info` to print the bounds."},
    {"W-CLIP-NOTHING", "`clip` keeps nothing.", "Reverse the plane, keep the other side, or move the box."},
};

} // namespace facetmill
