#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages optimize_messages{
    {"W-OPTIMIZE",
     "`optimize` removes and merges nothing in a document, because an extension may refer to items by their "
     "numbers.",
     "Export the file without the extension that the message names, if you do not need it."},
    {"W-PALETTE",
     "`optimize` made no palette, because texture coordinates cannot distinguish more than 512 materials.",
     "Use `only` to optimize fewer parts at a time."},
};

} // namespace facetmill
