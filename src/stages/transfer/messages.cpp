#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages transfer_messages{
    {"W-TRANSFER-NONE", "`transfer` found no attribute to take in the other mesh.",
     "List the attributes of the file with `facetmill info`, and give the name of one of them."},
    {"W-TRANSFER-SEAMS",
     "Faces cross a seam of the other mesh, so their texture coordinates mix values from both sides.",
     "Cut the scene along these seams, or take other attributes only."},
    {"W-TRANSFER-SKIN",
     "A part without a skin got joints and weights, which viewers do not use without a skin.",
     "Give the part a skin with the same joints, or list the attributes to take without these."},
};

} // namespace facetmill
