#pragma once
// Detects whether output goes to a terminal.

namespace facetmill {

bool standard_error_is_terminal();

} // namespace facetmill
