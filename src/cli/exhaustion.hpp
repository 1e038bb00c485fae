#pragma once
// What happens when there is no memory left at all.

namespace facetmill::cli {

/// From now on a request for memory that fails is an error of who asked (std::bad_alloc) as long as small
/// ones succeed. When these fail too, a reserve is given back once, so that destructors and messages, which
/// ask for a little, get it; and when that is used up, the process ends in order: temporaries are removed,
/// exit code 7. So it does where nothing catches that memory has ended, from before main on.
void prepare_for_exhaustion();

} // namespace facetmill::cli
