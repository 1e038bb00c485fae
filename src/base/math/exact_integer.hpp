#pragma once
// Doubles as integers, so that + - * have neither rounding nor overflow. Slow; for the few cases that sums of
// doubles (base/math/exact_sum.hpp) cannot represent.

#include <gmpxx.h>

namespace facetmill {

/// x in units of the smallest double, 2^-1074: an integer for every finite number, and 0 for other numbers.
[[nodiscard]] mpz_class exact_integer(double x);

/// The double nearest to n * 2^-power, or an adjacent one. It has n's sign, is finite, and is 0 only if n is.
[[nodiscard]] double rounded(const mpz_class& n, int power);

} // namespace facetmill
