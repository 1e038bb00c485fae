#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages threemf_messages{
    {"E-3MF", "A 3MF file is malformed: its XML, its numbers or its references are wrong.",
     "Export the file again. The message gives the line of the model in the archive.", ErrorKind::malformed},
    {"W-3MF",
     "A 3MF file breaks a rule of its specification, for example it names colours that do not exist. "
     "facetmill reads it as the message says.",
     "Export the file again, and check the result."},
    {"E-UNIT",
     "A length has a physical unit, but the scene has no unit. Or a format lacks a unit, as 3MF lacks km.",
     "Give the unit of the file with `load: {unit: mm}`, or use a bare number or a percentage.",
     {ErrorKind::usage, ErrorKind::stage}},
};

} // namespace facetmill
