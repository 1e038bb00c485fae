#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages align_messages{
    {"W-ALIGN",
     "After `align`, the samples are still far from the other mesh, or the iterations ended before the move "
     "settled.",
     "Check that both meshes show the same object in the same unit. If only a part of the object is in both "
     "meshes, give a smaller `keep`. If the scene is nearly in place, use `start: here`."},
};

} // namespace facetmill
