#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages section_messages{
    {"W-OPEN-SECTION",
     "A section has open contours because the mesh is open where the plane cuts it. Or the mesh is open, and "
     "closed contours run clockwise, for example around the pits of a terrain.",
     "A terrain or a sheet has no inside and no area, so use only its lines, or make it a solid with "
     "`thicken`. Close the holes of a solid with `clean: {holes: minimal}`."},
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
