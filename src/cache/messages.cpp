#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages cache_messages{
    {"W-CACHE",
     "The cache that `--cache` or FACETMILL_CACHE asked for cannot be written, or one of its entries is "
     "damaged. The run continues with the same result, and `--strict` ignores this warning.",
     "Free some space on its disk, choose another folder with FACETMILL_CACHE, or use `--no-cache`."},
};

} // namespace facetmill
