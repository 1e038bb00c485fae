#include "platform/file_lock.hpp"

#include "platform/windows/handle.hpp"
#include "platform/windows/last_error.hpp"

namespace facetmill {

namespace {

/// A byte beyond the end of all files. Others could not read or write a locked byte of the contents.
OVERLAPPED locked_byte() {
    OVERLAPPED at{};
    at.OffsetHigh = 0x7fffffff;
    return at;
}

} // namespace

bool try_lock(const Descriptor& file, Lock lock) {
    const DWORD how = LOCKFILE_FAIL_IMMEDIATELY | (lock == Lock::exclusive ? LOCKFILE_EXCLUSIVE_LOCK : 0);
    OVERLAPPED at = locked_byte();
    ::UnlockFileEx(handle_of(file), 0, 1, 0, &at); // a second lock replaces the first
    at = locked_byte();
    return ::LockFileEx(handle_of(file), how, 0, 1, 0, &at) ? true : failed_by_last_error();
}

} // namespace facetmill
