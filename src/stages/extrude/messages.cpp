#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages extrude_messages{
    {"E-EXTRUDE",
     "`extrude` cannot make a solid. The surface overhangs, is closed or edge-on, crosses the level, or some "
     "faces look up and others down.",
     "Give a level below or above the whole surface. Use `thicken` for surfaces that overhang.",
     {ErrorKind::stage, ErrorKind::usage}},
};

} // namespace facetmill
