#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages split_messages{
    {"W-SPLIT-NOTHING",
     "`split` leaves a part unchanged because it already has `max_faces`, or because the method splits none "
     "of its faces.",
     "Use another target or method if you want to split faces."},
    {"W-SPLIT-SHARED", "`split` made edges with more than two faces, because some faces share two edges.",
     "Use `clean` first."},
    {"W-SPLIT-STOPPED", "`split` stopped before it reached `max_edge` or `min_angle`.",
     "Allow more passes or a longer `max_edge`. `split` cannot make narrow faces more regular, but `relax` "
     "can."},
};

} // namespace facetmill
