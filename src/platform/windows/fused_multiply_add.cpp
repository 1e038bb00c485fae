// fma and fmaf of the C library, rounded once. Those of mingw-w64 round several times, and exact predicates
// rely on the difference between a product and its rounded value.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace facetmill {

namespace {

__extension__ using Wide = __int128;
__extension__ using UnsignedWide = unsigned __int128;

/// A number as mantissa * 2^exponent. The mantissa has 53 bits.
struct Scaled {
    Wide mantissa = 0;
    int exponent = 0;

    explicit Scaled(double x) {
        constexpr int bits = 53;
        mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), bits));
        exponent -= bits;
    }
};

/// Shifts right. The lowest bit is then set if any bit that was shifted out is set.
UnsignedWide shifted(UnsignedWide x, int bits) {
    constexpr int all = 128;
    if (bits <= 0) return x << -bits;
    if (bits >= all) return x != 0 ? 1 : 0;
    const UnsignedWide kept = x >> bits;
    return kept | ((kept << bits) != x ? 1 : 0);
}

int width_of(UnsignedWide x) {
    const auto high = static_cast<std::uint64_t>(x >> 64), low = static_cast<std::uint64_t>(x);
    return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(low);
}

/// Rounds mantissa * 2^exponent to the nearest double. Of two, it takes the one whose last bit is 0.
double rounded(UnsignedWide mantissa, int exponent) {
    constexpr int bits = 53, least_exponent = -1074;
    // The exponent of the quarter of the last bit of the result
    const int quarter = std::max(exponent + width_of(mantissa) - bits, least_exponent) - 2;
    const auto quarters = static_cast<std::uint64_t>(shifted(mantissa, quarter - exponent));
    std::uint64_t whole = quarters >> 2;
    const std::uint64_t rest = quarters & 3;
    if (rest == 3 || (rest == 2 && (whole & 1) != 0)) ++whole;
    return std::ldexp(static_cast<double>(whole), quarter + 2);
}

double multiply_add(double x, double y, double z) {
    if (!std::isfinite(x) || !std::isfinite(y) || x == 0 || y == 0) return x * y + z;
    if (!std::isfinite(z)) return z;
    if (z == 0) return x * y;
    const Scaled a(x), b(y), c(z);
    constexpr int room_of_product = 20, room_of_sum = 73; // both then have 125 or 126 bits
    Wide product = (a.mantissa * b.mantissa) * (Wide{1} << room_of_product);
    Wide sum = c.mantissa * (Wide{1} << room_of_sum);
    const int product_exponent = a.exponent + b.exponent - room_of_product,
              sum_exponent = c.exponent - room_of_sum, exponent = std::max(product_exponent, sum_exponent);
    const auto aligned = [&](Wide v, int from) {
        const UnsignedWide size = shifted(static_cast<UnsignedWide>(v < 0 ? -v : v), exponent - from);
        return v < 0 ? -static_cast<Wide>(size) : static_cast<Wide>(size);
    };
    product = aligned(product, product_exponent);
    sum = aligned(sum, sum_exponent);
    const Wide all = product + sum;
    if (all == 0) return 0;
    const double size = rounded(static_cast<UnsignedWide>(all < 0 ? -all : all), exponent);
    return all < 0 ? -size : size;
}

/// The product is exact. The sum is rounded to odd, so that rounding it to float is right.
float float_multiply_add(float x, float y, float z) {
    const double product = double{x} * double{y}, sum = product + double{z};
    const double back = sum - product, error = (product - (sum - back)) + (double{z} - back);
    if (!std::isfinite(sum) || error == 0) return static_cast<float>(sum);
    const auto bits = std::bit_cast<std::uint64_t>(sum);
    if ((bits & 1) != 0) return static_cast<float>(sum);
    const bool grows = (error > 0) == (sum > 0);
    return static_cast<float>(std::bit_cast<double>(grows ? bits + 1 : bits - 1));
}

/// Only for processors that have the instruction.
[[gnu::target("fma")]] double by_processor(double x, double y, double z) { return __builtin_fma(x, y, z); }
[[gnu::target("fma")]] float by_processor(float x, float y, float z) { return __builtin_fmaf(x, y, z); }

bool has_instruction() {
    static const bool has = [] {
        __builtin_cpu_init();
        return __builtin_cpu_supports("fma") != 0;
    }();
    return has;
}

} // namespace

} // namespace facetmill

extern "C" double fma(double x, double y, double z) {
    using namespace facetmill;
    return has_instruction() ? by_processor(x, y, z) : multiply_add(x, y, z);
}

extern "C" float fmaf(float x, float y, float z) {
    using namespace facetmill;
    return has_instruction() ? by_processor(x, y, z) : float_multiply_add(x, y, z);
}
