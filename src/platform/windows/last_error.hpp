#pragma once
// Errors of Windows as errno, which the rest of the program reads.

namespace facetmill {

/// Sets errno from the last error of Windows. Returns false, for functions that return whether they
/// succeeded.
bool failed_by_last_error() noexcept;

} // namespace facetmill
