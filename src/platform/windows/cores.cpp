#include "platform/cores.hpp"

#include <algorithm>
#include <thread>

namespace facetmill {

/// The affinity of this process limits what the C++ library counts.
int allowed_cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

} // namespace facetmill
