#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages stl_messages{
    {"E-STL", "An STL file is malformed or truncated.", "Export the file again.", ErrorKind::malformed},
    {"W-TRAILING", "facetmill skips bytes after the last triangle of an STL file.",
     "Ignore this warning. The exporter has a bug."},
};

} // namespace facetmill
