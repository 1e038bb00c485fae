#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages drawing_messages{
    {"E-DRAWING", "The suffix of a drawing is not a known drawing format.",
     "Use .svg, .dxf, .geojson or .json.", ErrorKind::usage},
};

} // namespace facetmill
