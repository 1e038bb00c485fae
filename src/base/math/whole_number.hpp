#pragma once
// Converts computed numbers to integers. A plain cast is undefined for NaN and for numbers out of range.

#include <cmath>
#include <limits>

namespace facetmill {

/// x without its fraction, clamped to the range of T. NaN gives 0.
template <class T>
[[nodiscard]] T whole_number(double x) {
    if (x >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    if (x > static_cast<double>(std::numeric_limits<T>::min())) return static_cast<T>(x);
    return std::isnan(x) ? T{} : std::numeric_limits<T>::min();
}

} // namespace facetmill
