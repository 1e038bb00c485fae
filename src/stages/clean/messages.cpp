#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages clean_messages{
    {"W-CLEAN", "`clean` could not do some repairs, so the mesh is unchanged in those places.",
     "Use `orient` before `clean` if a hole was not filled, because its neighbouring faces must agree. For "
     "the other steps, `clean: {self_intersections: all}` replaces the faces at the positions in the "
     "message."},
};

} // namespace facetmill
