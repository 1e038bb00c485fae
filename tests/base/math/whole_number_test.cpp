#include "base/math/whole_number.hpp"
#include "support/catch.hpp"

#include <cstdint>

using namespace facetmill;

TEST_CASE("numbers become integers, also NaN and those out of range", "[base]") {
    CHECK(whole_number<int>(2.9) == 2);
    CHECK(whole_number<int>(-2.9) == -2);
    CHECK(whole_number<int>(NAN) == 0);
    CHECK(whole_number<int>(1e300) == INT32_MAX);
    CHECK(whole_number<int>(-HUGE_VAL) == INT32_MIN);
    CHECK(whole_number<std::uint32_t>(-1) == 0);
    CHECK(whole_number<std::uint32_t>(4294967295.0) == UINT32_MAX);
    CHECK(whole_number<std::uint8_t>(255.5) == 255);
    CHECK(whole_number<std::int64_t>(0x1p63) == INT64_MAX);
    CHECK(whole_number<std::int64_t>(-0x1p63) == INT64_MIN);
    CHECK(whole_number<std::int64_t>(0x1.fffffffffffffp62) == 0x7ffffffffffffc00);
    CHECK(whole_number<std::size_t>(HUGE_VAL) == SIZE_MAX);
}
