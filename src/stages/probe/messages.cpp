#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages probe_messages{
    {"E-FACE", "The mesh has no face with this number.",
     "Use a number from 0 to one less than the count of faces that `facetmill info` prints.",
     ErrorKind::usage},
    {"E-RAY", "A ray has no direction.",
     "Give the ray an origin and a direction. Use segments to go from point to point.", ErrorKind::usage},
    {"W-PROBE-OPEN", "The surface is open, so it has no inside and no outside.",
     "Close it first with `clean`."},
};

} // namespace facetmill
