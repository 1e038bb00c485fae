#pragma once
// Selects indices by a predicate, in parallel.

#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

/// The numbers below n for which is_wanted(number) is true, ascending. The predicate is called once for each
/// number, from several threads.
template <class IsWanted>
[[nodiscard]] std::vector<Index> indices_where(std::size_t n, IsWanted&& is_wanted) {
    std::vector<std::vector<Index>> parts((n + default_chunk - 1) / default_chunk);
    parallel_chunks(n, [&](std::size_t begin, std::size_t end) {
        std::vector<Index>& part = parts[begin / default_chunk];
        part.resize(end - begin);
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            part[count] = static_cast<Index>(i);
            count += is_wanted(static_cast<Index>(i)) ? 1 : 0;
        }
        part.resize(count);
    });
    std::vector<std::size_t> first(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) first[i] = parts[i].size();
    std::vector<Index> all(exclusive_scan(first));
    parallel_for(
        parts.size(),
        [&](std::size_t i) {
            std::copy(parts[i].begin(), parts[i].end(), all.begin() + static_cast<std::ptrdiff_t>(first[i]));
        },
        4);
    return all;
}

} // namespace facetmill
