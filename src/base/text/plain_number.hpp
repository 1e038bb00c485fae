#pragma once
// Numbers of messages and help, most of which are counts and limits of counts.

#include "base/math/numbers.hpp"

#include <cmath>
#include <cstdint>
#include <string>

namespace facetmill {

/// The shortest text that reads as the same number; whole numbers of up to 15 digits without an exponent,
/// which 1e+05 has where 100000 is longer.
inline std::string plain_number(double x) {
    return x == std::floor(x) && std::abs(x) < 1e15 ? std::to_string(static_cast<std::int64_t>(x))
                                                    : to_string(x);
}

} // namespace facetmill
