#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages measure_messages{
    {"W-SHELLS",
     "Closed shells of a part lie within each other and all face outward, or they pass through each other. "
     "Their "
     "volumes are added, so some space counts several times.",
     "Use `orient` first to make inner shells cavities, or `clean: {self_intersections: union}` to unite "
     "shells that "
     "pass through each other."},
};

} // namespace facetmill
