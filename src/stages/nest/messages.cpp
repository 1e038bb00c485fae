#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages nest_messages{
    {"E-NEST",
     "`nest` finds no place for a part, because it is larger than the plate or no more plates are allowed.",
     "Allow more `plates`, use a smaller `spacing`, cut the part with `tile: {fit: ...}`, or scale it with "
     "`transform: {fit: ..., shrink_only: true}`.",
     {ErrorKind::stage, ErrorKind::usage}},
};

} // namespace facetmill
