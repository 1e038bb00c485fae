#pragma once
// What tells this program from another build of it.

#include <string>

namespace facetmill::batch {

/// The identity that the linker gave the program; without one, its version, size and time.
const std::string& build_id();

} // namespace facetmill::batch
