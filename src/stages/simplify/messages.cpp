#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages simplify_messages{
    {"W-SIMPLIFY-LIMIT",
     "`simplify` stopped above its target because fewer triangles would move the surface by more than "
     "`max_quadric_error`. The default limit is 1 % of each part's diagonal.",
     "Ask for more triangles, or allow a larger `max_quadric_error`, such as `5% of part`. "
     "`max_quadric_error: off` simplifies to the target regardless of the error."},
    {"W-SIMPLIFY-NOTHING", "`simplify` changes nothing because the target is not below the size of the mesh.",
     "Choose a lower target, or ignore this warning."},
    {"W-SIMPLIFY-STOPPED", "`simplify` stopped above its target because of borders, topology or flips.",
     "Follow the hint of the message. `simplify: {ratio: 10%, method: cluster}` "
     "does not keep the borders of texture islands, materials and groups. `clean` repairs non-manifold "
     "regions, and `topology: allow` lets small components and holes vanish."},
    {"W-SIMPLIFY-VANISHED", "`simplify` removed all faces of a part.",
     "Use a higher target, or exclude the part with `only`."},
};

} // namespace facetmill
