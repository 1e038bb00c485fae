#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages remesh_messages{
    {"W-REMESH-INTERSECTS", "Faces of the result of `remesh` intersect, but those of the input do not.",
     "Give a shorter `length`, or a smaller `tolerance` or `min_length`."},
    {"W-REMESH-NO-AREA", "`remesh` left a part unchanged, because none of its faces has an area.",
     "Remove such faces with `clean`."},
    {"W-REMESH-TOLERANCE", "The result of `remesh` is farther from the input than `tolerance`.",
     "Give a smaller `tolerance`, or a smaller `min_length` if edges of this length are too long."},
};

} // namespace facetmill
