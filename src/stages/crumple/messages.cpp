#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages crumple_messages{
    {"E-INTERSECTS", "Faces would intersect, and you asked `crumple` to fail in that case.",
     "Use a smaller amplitude, or `self_intersections: avoid`.", ErrorKind::stage},
    {"W-AMPLITUDE", "`crumple` moves vertices farther than the length of the edges, so faces intersect.",
     "Use a smaller amplitude, or `self_intersections: avoid`."},
    {"W-CRUMPLE-COARSE",
     "With `self_intersections: avoid`, `crumple` reduced displacements in large steps to limit the work. "
     "Vertices move less than necessary, and no new intersections occur.",
     "Use a smaller amplitude or a smaller grid if the surface is too smooth."},
    {"W-CRUMPLE-PARTS",
     "Parts are near each other, and `crumple` avoids intersections only between faces of the same part.",
     "Use `merge` first."},
    {"W-CRUMPLE-ROUNDED",
     "`crumple` rounds positions to float32 to avoid intersections. Far from the origin, this moves vertices "
     "noticeably.",
     "Move the part to its origin first, or use `self_intersections: allow`."},
};

} // namespace facetmill
