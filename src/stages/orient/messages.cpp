#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages orient_messages{
    {"W-ORIENT", "A part is not orientable and stays unchanged.",
     "Cut it at the position in the message with `clip`, or give it faces on both sides with `two-sided`."},
    {"W-ORIENT-OPEN", "The outside of an open part is not clear.",
     "Close it first with `clean`, or check the image that `render` makes."},
};

} // namespace facetmill
