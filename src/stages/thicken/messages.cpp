#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages thicken_messages{
    {"E-THICKEN", "The part cannot get a thickness because its node flattens it or the thickness is 0.",
     "Use `transform: {bake: true}` to make it a flat mesh, or give a length in scene units.",
     ErrorKind::stage},
    {"W-THICKEN",
     "Walls of a thickened part intersect, lie inside each other or are inverted because there is too little "
     "room. Or the part is smaller than the thickness.",
     "Give a smaller thickness, or `clean` the result."},
    {"W-THICKEN-DRAIN", "`thicken: {drain}` makes no hole, or leaves a cavity closed.",
     "Use a smaller `diameter`, or `self_intersections: resolve`. A part without a cavity needs no drain."},
    {"W-THICKEN-OPEN", "The solid is not closed, because the surface is not oriented.",
     "Use `orient` first."},
    {"W-THICKEN-THIN", "A wall is thinner than requested in some places.",
     "Split the faces there with `split` first, or accept the thin wall."},
    {"W-THICKEN-TOPOLOGY",
     "`self_intersections: resolve` rebuilt a solid, and a side of its wall has a different Euler number "
     "than the surface. The cavity has lost or gained holes, handles or pieces. This is right where a thin "
     "neck fills up, but not where the walls have room.",
     "Look at the cavity with `section` or `render`, and give a smaller thickness if it is not as expected."},
};

} // namespace facetmill
