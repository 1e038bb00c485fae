#include "platform/file_lock.hpp"

#include <sys/file.h>

namespace facetmill {

bool try_lock(const Descriptor& file, Lock lock) {
    return ::flock(file.number(), (lock == Lock::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0;
}

} // namespace facetmill
