#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages relax_messages{
    {"W-RELAX-STOPPED",
     "`relax` did not converge. It did not reach `until` within its iterations, or it stopped before a third "
     "of the surface's area was lost.",
     "Give more iterations or a larger `until`. If the surface shrinks, use `method: hc` or `taubin`."},
};

} // namespace facetmill
