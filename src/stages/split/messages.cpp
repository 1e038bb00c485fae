#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages split_messages{
    {"W-SPLIT-NOTHING",
     "`split` leaves a part unchanged, because it already has `max_faces` or has no faces that the method "
     "splits.",
     "Use another target or method if you want to split faces."},
    {"W-SPLIT-SHARED", "`split` made edges with more than two faces at faces that share two edges.",
     "Use `clean` first."},
    {"W-SPLIT-STOPPED", "`split` stopped before it reached `max_edge` or `min_angle`.",
     "Allow more passes or a longer `max_edge`. `relax` makes narrow faces more regular, which `split` "
     "cannot do."},
};

} // namespace facetmill
