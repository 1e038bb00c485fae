#pragma once
// The Windows handle of an open file.

#include "platform/descriptor.hpp"

#include <io.h>
#include <windows.h>

namespace facetmill {

/// INVALID_HANDLE_VALUE if the descriptor is false.
inline HANDLE handle_of(const Descriptor& file) {
    return file ? reinterpret_cast<HANDLE>(::_get_osfhandle(file.number())) : INVALID_HANDLE_VALUE;
}

} // namespace facetmill
