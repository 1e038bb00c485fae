#pragma once
// Locks of open files; closing the file releases them.

#include "platform/descriptor.hpp"

namespace facetmill {

enum class Lock { shared, exclusive };

/// Takes the lock without waiting. False, with errno, if another process holds the lock (EWOULDBLOCK), or if
/// the file system has no locks.
bool try_lock(const Descriptor& file, Lock lock = Lock::exclusive);

} // namespace facetmill
