#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages base_messages{
    {"E-BUG", "An internal error occurred in facetmill.", "Report this bug with the pipeline and the input.",
     ErrorKind::bug},
    {"E-CONFLICT",
     "Options conflict: one excludes the other, has no effect without it, or cannot achieve the result that "
     "the other requires.",
     "Remove one of them. The message says which options can be used together.", ErrorKind::usage},
    {"E-MEMORY", "The available memory is not enough.",
     "Simplify earlier, use fewer threads, or use a machine with more memory.", ErrorKind::limit},
};

} // namespace facetmill
