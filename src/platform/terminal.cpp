#include "platform/terminal.hpp"

#include <algorithm>
#include <unistd.h>

namespace facetmill {

std::vector<std::string> arguments_of_program(int argc, char** argv) {
    return {argv + 1, argv + std::max(argc, 1)};
}

void prepare_streams() {}

bool standard_error_is_terminal() { return ::isatty(STDERR_FILENO) != 0; }

} // namespace facetmill
