#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages split_messages{
    {"E-MANIFOLD", "The method needs a manifold, oriented mesh.",
     "Use `clean` and `orient` first, or choose another method.", ErrorKind::stage},
    {"E-POLYGON", "A face has more corners than the method supports.",
     "Use `triangulate` first, or choose another method.", ErrorKind::stage},
};

} // namespace facetmill
