#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages section_messages{
    {"E-SECTION",
     "The spacing of sections is 0, or it gives too many sections.",
     "Choose a larger spacing, or give a count.",
     {ErrorKind::limit, ErrorKind::stage}},
};

} // namespace facetmill
