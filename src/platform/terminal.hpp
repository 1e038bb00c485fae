#pragma once
// The start of the program, its standard streams and the terminal.

#include <string>
#include <vector>

namespace facetmill {

/// The arguments after the program's name, in UTF-8.
[[nodiscard]] std::vector<std::string> arguments_of_program(int argc, char** argv);

/// Standard streams then transfer bytes unchanged, and a terminal shows UTF-8 and colours.
void prepare_streams();

bool standard_error_is_terminal();

} // namespace facetmill
