#pragma once
// Whether this process may start others after it drops its rights.

#include <atomic>

namespace facetmill {

inline std::atomic<bool> needs_child_processes{false};

} // namespace facetmill
