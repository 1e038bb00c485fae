#include "support/catch.hpp"

#if defined(__x86_64__)

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

// The functions of the C library stay as they are in this program.
#define fma fma_of_windows
#define fmaf fmaf_of_windows
#include "platform/windows/fused_multiply_add.cpp"
#undef fma
#undef fmaf

using namespace facetmill;

namespace {

/// Any double: every second one near 1, some with few bits.
double any_double(std::mt19937_64& random) {
    std::uint64_t bits = random();
    if (random() % 2 != 0) bits = (bits & 0x800fffffffffffff) | (993 + random() % 60) << 52;
    if (random() % 8 == 0) bits &= 0xfffffffff8000000;
    return std::bit_cast<double>(bits);
}

bool is_same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

} // namespace

TEST_CASE("fma for Windows rounds once, as the C library of Linux does", "[platform]") {
    std::mt19937_64 random(1);
    int different = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double x = any_double(random), y = any_double(random), other = any_double(random);
        const double z = i % 3 == 0 ? -x * y : i % 7 == 0 ? -x * y * (1 + 0x1p-50) : other;
        different += !is_same(multiply_add(x, y, z), std::fma(x, y, z));
        different += !is_same(fma_of_windows(x, y, z), std::fma(x, y, z));
        const auto a = static_cast<float>(x), b = static_cast<float>(y), c = static_cast<float>(z);
        different += !is_same(float_multiply_add(a, b, c), std::fma(a, b, c));
    }
    CHECK(different == 0);
    CHECK(std::signbit(multiply_add(-0.0, 1, -0.0)));
    CHECK(multiply_add(0x1p-1074, 0.5, 0x1p-1074) == 0x1p-1073); // halfway between two: the even one
}

#endif
