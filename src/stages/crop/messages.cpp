#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages crop_messages{
    {"W-CROP-ALL", "The outline of `crop` cuts no part, so the whole scene is kept.",
     "Check the outline and its axis. Run `facetmill info` to print the bounds."},
    {"W-CROP-NOTHING", "`crop` keeps nothing.", "Check the outline and its axis, or keep the outside."},
};

} // namespace facetmill
