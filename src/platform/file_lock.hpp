#pragma once
// Locks of open files, which end with them.

#include "platform/descriptor.hpp"

namespace facetmill {

enum class Lock { shared, exclusive };

/// Does not wait. False, with errno, when another holds it (EWOULDBLOCK) or the system has no locks there.
bool try_lock(const Descriptor& file, Lock lock = Lock::exclusive);

} // namespace facetmill
