#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages relax_messages{
    {"E-SOLVE", "A system of equations did not converge.", "Use a smaller `lambda` and more iterations.",
     ErrorKind::stage},
};

} // namespace facetmill
