#pragma once
// What tells this program from another build of it.

#include <string>

namespace facetmill {

/// The identity that the linker gave the program; without one, its version, size and time.
const std::string& build_id();

/// The identity of this program and of the libraries that were there when it was first asked for: what a
/// stored result depends on besides its inputs. A hexadecimal digest. Ask for it early, before libraries that
/// are needed at times only are loaded.
const std::string& code_id();

} // namespace facetmill
