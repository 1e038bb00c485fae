#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages stl_messages{
    {"E-STL", "An STL file is malformed or truncated.", "Export the file again.", ErrorKind::malformed},
    {"W-COUNT", "The header of an STL file has a wrong number of triangles, and facetmill reads all of them.",
     "Check that the mesh is complete, for example with `facetmill info`. The exporter has a bug."},
};

} // namespace facetmill
