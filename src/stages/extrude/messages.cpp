#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages extrude_messages{
    {"E-EXTRUDE",
     "`extrude` cannot make a solid: the surface overhangs, is closed or edge-on, looks both ways, or "
     "reaches "
     "both above and below the level.",
     "Give a level below or above the whole surface. Use `thicken` for surfaces that overhang.",
     {ErrorKind::stage, ErrorKind::usage}},
};

} // namespace facetmill
