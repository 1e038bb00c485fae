#pragma once
// See parallel_for.h.

namespace tbb::info {

inline int default_concurrency() { return 4; }

} // namespace tbb::info
