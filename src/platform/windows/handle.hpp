#pragma once
// The Windows handle of an open file.

#include "platform/descriptor.hpp"

#include <cstdint>
#include <fcntl.h>
#include <io.h>
#include <windows.h>

namespace facetmill {

/// INVALID_HANDLE_VALUE if the descriptor is false.
inline HANDLE handle_of(const Descriptor& file) {
    return file ? reinterpret_cast<HANDLE>(::_get_osfhandle(file.number())) : INVALID_HANDLE_VALUE;
}

/// The descriptor of a new handle, which transfers bytes unchanged. On failure, the handle is closed.
inline Descriptor descriptor_of(HANDLE handle, int flags = 0) {
    Descriptor file(
        ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY | _O_NOINHERIT | flags));
    if (!file) ::CloseHandle(handle);
    return file;
}

} // namespace facetmill
