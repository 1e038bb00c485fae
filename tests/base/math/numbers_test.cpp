#include "base/math/numbers.hpp"
#include "base/text/plain_number.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("float32 rounding is done for neighbours in memory too", "[base]") {
    double numbers[] = {0.1, 0.2, 0.3, 0.4};
    for (double& x : numbers) x = as_float32(x);
    CHECK(numbers[0] == 0.100000001490116119384765625);
    CHECK(numbers[1] == 0.20000000298023223876953125);
    CHECK(as_float32(0.5) == 0.5);
}

TEST_CASE("whole numbers have no exponent where people read them", "[base]") {
    CHECK(plain_number(100000) == "100000");
    CHECK(plain_number(-7e8) == "-700000000");
    CHECK(plain_number(0.1) == "0.1");
    CHECK(plain_number(1e15) == "1e+15");
    CHECK(plain_number(1e-7) == "1e-07");
    CHECK(plain_number(HUGE_VAL) == "inf");
}
