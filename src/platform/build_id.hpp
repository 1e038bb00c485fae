#pragma once
// Distinguishes this build of the program from others.

#include <string>

namespace facetmill {

/// The build id from the linker. Without it, the program's version, size and time.
const std::string& build_id();

/// A digest of the program's and its loaded libraries' identities, on which a stored result depends besides
/// its inputs. Hexadecimal. Computed on the first call: call it early, before libraries are loaded on
/// demand.
const std::string& code_id();

} // namespace facetmill
