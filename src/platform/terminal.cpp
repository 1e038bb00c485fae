#include "platform/terminal.hpp"

#include <unistd.h>

namespace facetmill {

bool standard_error_is_terminal() { return ::isatty(STDERR_FILENO) != 0; }

} // namespace facetmill
