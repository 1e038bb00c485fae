#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages transfer_messages{
    {"W-TRANSFER-NONE", "`transfer` found no attribute in the other mesh that it can take.",
     "Run `facetmill info FILE` to list the attributes of the other mesh, and give their names as "
     "`attributes`."},
    {"W-TRANSFER-SEAMS",
     "Faces cross a seam of the other mesh, so their texture coordinates mix values from both sides.",
     "Cut the scene along these seams, or list other attributes in `attributes`."},
    {"W-TRANSFER-SKIN",
     "A part without a skin got joints and weights, which viewers do not use without a skin.",
     "Use a part that has a skin with the same joints, or list `attributes` without JOINTS_0 and WEIGHTS_0."},
};

} // namespace facetmill
