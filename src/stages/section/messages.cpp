#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages section_messages{
    {"W-OPEN-SECTION", "A section has open contours because the mesh is open where the plane cuts it.",
     "Close holes with `clean`. The section of a surface without an inside, such as a terrain, consists of "
     "open lines without area."},
    {"W-SECTION-CROSSES",
     "Contours of a section intersect themselves. Every region that they wind around, in either direction, "
     "counts as inside.",
     "Use `clean: {self_intersections: all}` first."},
    {"W-UNORIENTED",
     "Neighbouring faces are oriented inconsistently, so facetmill distinguishes outlines and holes by their "
     "nesting.",
     "Use `orient` first."},
};

} // namespace facetmill
