#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages geometry_messages{
    {"E-FOOTPRINT",
     "A footprint has no polygon, or its polygon cannot be used.",
     "Give a POLYGON or MULTIPOLYGON, or closed polylines of a DXF.",
     {ErrorKind::usage, ErrorKind::malformed}},
};

} // namespace facetmill
