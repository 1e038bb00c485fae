#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages measure_messages{
    {"E-MASS", "A part has no positive mass, which robot simulators need.",
     "Close the part with `clean` or `wrap`, turn it outward with `orient`, or exclude it with `only`.",
     ErrorKind::stage},
    {"W-SHELLS",
     "Closed shells of a part lie within each other and all face outward, or they pass through each other. "
     "The sum of their volumes, which the property volume gives, counts some space several times. The "
     "results "
     "of measure for the solid, and the property solid_volume, count it once.",
     "Use `orient` first to make inner shells cavities, or `clean: {self_intersections: union}` to unite "
     "shells that pass through each other."},
};

} // namespace facetmill
