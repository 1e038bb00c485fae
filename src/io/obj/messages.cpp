#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages obj_messages{
    {"E-MTL", "A material library of an OBJ file is malformed.", "Correct the line given in the message.",
     ErrorKind::malformed},
    {"E-OBJ", "An OBJ file is malformed at the line given in the message.",
     "Correct the line, or export the file again.", ErrorKind::malformed},
    {"W-GROUPS",
     "The names of groups in an OBJ file are lost, because the groups share vertices or are inside objects. "
     "In a file without objects, groups that share no vertex become named parts.",
     "Use materials or objects if you need the names."},
    {"W-INDEX", "Corners refer to texture points or normals that the OBJ file does not have.",
     "Export the file again."},
    {"W-MTL",
     "A material library of an OBJ file is missing, is in another directory, or has statements that glTF "
     "cannot represent. Or glTF materials have properties that MTL cannot represent.",
     "Put the library in the folder of the OBJ file, or allow a common folder with `--asset-root DIR`. The "
     "message names the statements that are lost."},
    {"W-OBJECTS",
     "Objects in an OBJ file share vertices. Each object becomes a part with its own copies of these "
     "vertices.",
     "Use `merge` to make one connected surface of the parts."},
};

} // namespace facetmill
