#pragma once
// Doubles as integers: + - * of them know neither rounding nor overflow. Slow; for the few cases that
// sums of doubles (base/math/exact_sum.hpp) cannot hold.

#include <gmpxx.h>

namespace facetmill {

/// x in units of the smallest double, 2^-1074: an integer for every finite number, and 0 for the others.
mpz_class exact_integer(double x);

/// The double nearest to n * 2^-power, or next to it; of n's sign, finite, and not 0 unless n is.
double rounded(const mpz_class& n, int power);

} // namespace facetmill
