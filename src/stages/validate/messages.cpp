#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages validate_messages{
    {"E-BASELINE",
     "You gave a baseline of `validate` but no stage uses it, or the file is not a baseline.",
     "Write a new baseline with `--update-baseline`.",
     {ErrorKind::usage, ErrorKind::malformed}},
    {"E-LIMITS",
     "`validate: {limits: ...}` limits the bytes, draw calls or pixels of written files, but no `write` "
     "comes "
     "before it.",
     "Put `write` before `validate`. If the check fails, the file does not appear. If `write` has a "
     "condition, "
     "give `validate` the same one.",
     {ErrorKind::usage, ErrorKind::stage}},
    {"W-BASELINE", "The mesh has none of the failures in the baseline, but it has others.",
     "Check whether the baseline belongs to another mesh, and write it again with `--update-baseline`."},
};

} // namespace facetmill
