#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages options_messages{
    {"E-CHOICE", "The value of an option is not one of its choices.",
     "Use one of the choices that the message lists.", ErrorKind::usage},
    {"E-KEY", "A map contains an unknown key.",
     "Use the name that the message suggests, or run `facetmill stages NAME` to list all.", ErrorKind::usage},
    {"E-MISSING", "A required option or key is missing.", "Add the option or key that the message names.",
     ErrorKind::usage},
    {"E-RANGE",
     "A number is outside its valid range.",
     "Use a number in the range that the message gives.",
     {ErrorKind::usage, ErrorKind::stage}},
    {"E-TYPE", "A value has the wrong type.",
     "Give a value of the type that the message names. The message has an example.", ErrorKind::usage},
    {"E-VALUE", "The stage does not take a bare value.", "Give its options by name.", ErrorKind::usage},
};

} // namespace facetmill
