#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages crumple_messages{
    {"E-TRANSFORM",
     "A transform is invalid: it flattens the parts, or has the wrong number of values.",
     "Correct the values. The message gives the expected form.",
     {ErrorKind::usage, ErrorKind::stage}},
};

} // namespace facetmill
