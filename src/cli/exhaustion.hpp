#pragma once
// Handles the exhaustion of memory.

namespace facetmill::cli {

/// From now on, a failing allocation throws std::bad_alloc while small allocations still succeed. When these
/// fail too, a reserve is released once for the small requests of destructors and messages. When the reserve
/// is used up, the process ends cleanly: temporaries are removed, exit code 7. The same happens if no
/// handler catches std::bad_alloc, even before main.
void prepare_for_exhaustion();

} // namespace facetmill::cli
