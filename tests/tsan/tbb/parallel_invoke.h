#pragma once
// See parallel_for.h.

#include <tbb/parallel_for.h>

namespace tbb {

template <class First, class Second>
void parallel_invoke(const First& first, const Second& second) {
    parallel_for(0, 2, [&](std::size_t i) { i == 0 ? first() : second(); });
}

} // namespace tbb
