#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages thicken_messages{
    {"E-THICKEN", "A part cannot be given a thickness because its node flattens it or the thickness is 0.",
     "Use `transform: {bake: true}` to make it a flat mesh, or give a length in scene units.",
     ErrorKind::stage},
    {"W-THICKEN",
     "The walls of a thickened part intersect, lie within each other or are inverted for lack of room. Or "
     "the part is smaller than its thickness.",
     "Give a smaller thickness, or `clean` the result."},
    {"W-THICKEN-OPEN", "The solid is not closed, because the surface is not oriented.",
     "Use `orient` first."},
    {"W-THICKEN-THIN", "A wall is thinner than requested in some places.",
     "Split the faces in these places first, or accept the thin wall."},
};

} // namespace facetmill
