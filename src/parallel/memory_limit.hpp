#pragma once
// The memory limit of the process, for programs that it starts. See set_memory_limit in parallel/memory.hpp.

#include <cstdint>

namespace facetmill {

/// In bytes; 0: no limit.
[[nodiscard]] std::uint64_t memory_limit();

} // namespace facetmill
