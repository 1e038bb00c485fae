#include "base/math/exact_integer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace facetmill {

mpz_class exact_integer(double x) {
    if (!std::isfinite(x)) return 0;
    int power = 0;
    const double fraction = std::frexp(x, &power);
    const int shift = power - 53 + 1074;
    mpz_class n = std::ldexp(fraction, 53);
    if (shift >= 0)
        n <<= static_cast<unsigned>(shift);
    else
        n /= mpz_class(1) << static_cast<unsigned>(-shift); // the removed bits are zero
    return n;
}

double rounded(const mpz_class& n, int power) {
    using Limits = std::numeric_limits<double>;
    if (sgn(n) == 0) return 0;
    long bits = 0;
    const double fraction = mpz_get_d_2exp(&bits, n.get_mpz_t());
    const double size = std::ldexp(std::abs(fraction), static_cast<int>(bits) - power);
    return std::copysign(std::clamp(size, Limits::denorm_min(), Limits::max()), fraction);
}

} // namespace facetmill
