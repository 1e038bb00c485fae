#pragma once
// Sorts values and removes duplicates.

#include <algorithm>
#include <utility>
#include <vector>

namespace facetmill {

/// Sorts the values by < and removes duplicates.
template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class T>
[[nodiscard]] std::vector<T> sorted_once(std::vector<T> values) {
    sort_unique(values);
    return values;
}

} // namespace facetmill
