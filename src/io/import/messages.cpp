#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages import_messages{
    {"E-IMPORT",
     "A helper program could not read a file of another format (FBX, STEP ...). The file is malformed, or "
     "the "
     "helper crashed, or needed too much memory or time. The helper runs in a sandbox of its own.",
     "Open the file in the program that made it, and export it as glTF (.glb) or STL. The variable "
     "FACETMILL_IMPORT_SECONDS sets the time limit (600).",
     {ErrorKind::malformed, ErrorKind::missing}},
    {"W-IMPORT",
     "Some content of a file of another format is missing or changed: glTF has no such content, or the "
     "helper "
     "does not convert it. Or an option for solids is given, but the file has no solids.",
     "Ignore this warning if you do not need the content that the message names."},
};

} // namespace facetmill
