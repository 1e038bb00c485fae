#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages polygon_messages{
    {"E-HATCH",
     "The spacing of a hatch is 0, or it gives too many lines.",
     "Choose a larger spacing.",
     {ErrorKind::limit, ErrorKind::stage}},
};

} // namespace facetmill
