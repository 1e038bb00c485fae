#pragma once
// Who reads what this process prints.

namespace facetmill {

bool standard_error_is_terminal();

} // namespace facetmill
