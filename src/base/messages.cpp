#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages base_messages{
    {"E-BUG", "An internal error occurred in facetmill.", "Report this bug with the pipeline and the input.",
     ErrorKind::bug},
    {"E-CONFLICT",
     "Two options exclude each other, one has no effect without the other, or one cannot give the result "
     "that the other requires.",
     "Remove one of them. The message says which options can be used together.", ErrorKind::usage},
    {"E-MEMORY", "The available memory is not enough.",
     "Simplify earlier, use fewer threads, or use a machine with more memory.", ErrorKind::limit},
};

} // namespace facetmill
