#pragma once
// Numbers in messages and help, mostly counts and their limits.

#include "base/math/numbers.hpp"

#include <cmath>
#include <cstdint>
#include <string>

namespace facetmill {

/// The shortest text that reads back as the same number. Whole numbers of up to 15 digits have no exponent:
/// 100000, not the shorter 1e+05.
[[nodiscard]] inline std::string plain_number(double x) {
    return x == std::floor(x) && std::abs(x) < 1e15 ? std::to_string(static_cast<std::int64_t>(x))
                                                    : to_string(x);
}

} // namespace facetmill
