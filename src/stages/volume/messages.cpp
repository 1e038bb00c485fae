#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages volume_messages{
    {"E-VOLUME",
     "`volume` cannot compare the surfaces. One of them has sheets above each other, or they do not overlap "
     "inside the footprint.",
     "Select the ground with `only`, or `orient` a surface that overhangs. Run `facetmill info` to print the "
     "bounds.",
     {ErrorKind::stage, ErrorKind::usage}},
    {"W-VOLUME-MISSING",
     "A part of the footprint of `volume` has no surface. It is not compared and adds no volume.",
     "Use a smaller footprint, or close holes with `clean: {holes: minimal}`."},
};

} // namespace facetmill
