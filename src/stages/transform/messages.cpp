#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages transform_messages{
    {"E-CRS",
     "`transform: {crs}` does not support the coordinate system, coordinates are outside it, or a part "
     "cannot be converted vertex by vertex.",
     "Give the UTM zone of the coordinates, for example `EPSG:25832`. Use `place` for a scene near its own "
     "origin, or with animations.",
     {ErrorKind::usage, ErrorKind::stage}},
};

} // namespace facetmill
