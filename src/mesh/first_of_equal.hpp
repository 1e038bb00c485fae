#pragma once
// Finds the first equal item for each of many items, by a hash table.

#include "mesh/mesh.hpp"

#include <bit>

namespace facetmill {

/// For each of `count` items (fewer than 2^32), the lowest index of an equal item. hash(i): a well-mixed
/// number, the same for equal items. equal(i, j): whether two items are equal. Only `equal` affects the
/// result. Expected O(count), with 8 to 16 bytes per item in addition to the result.
template <class Hash, class Equal>
[[nodiscard]] std::vector<Index> first_of_equal(std::size_t count, Hash&& hash, Equal&& equal) {
    std::vector<Index> first(count), slots(std::bit_ceil(2 * count + 1), none);
    const std::size_t mask = slots.size() - 1;
    for (Index i = 0; i < count; ++i) {
        std::size_t s = static_cast<std::size_t>(hash(i)) & mask;
        while (slots[s] != none && !equal(slots[s], i)) s = (s + 1) & mask;
        if (slots[s] == none) slots[s] = i;
        first[i] = slots[s];
    }
    return first;
}

} // namespace facetmill
