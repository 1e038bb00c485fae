#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages platform_messages{
    {"E-ARGUMENT", "The command does not take this argument, or a required argument is missing.",
     "Run `facetmill COMMAND --help` to list the arguments.", ErrorKind::usage},
};

} // namespace facetmill
