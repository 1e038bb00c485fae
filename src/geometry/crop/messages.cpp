#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages crop_messages{
    {"E-CROP-CAP", "`crop` cannot close the cut along the outline with walls.",
     "Crop without `cap`, or move the outline a little.", ErrorKind::stage},
};

} // namespace facetmill
