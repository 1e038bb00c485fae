#include "base/text/readable_numbers.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("percentages have three digits, and thousands no exponent", "[base]") {
    CHECK(percentage(0) == "0 %");
    CHECK(percentage(12.3456) == "12.3 %");
    CHECK(percentage(-0.5) == "-0.5 %");
    CHECK(percentage(999.4) == "999 %");
    CHECK(percentage(999.6) == "1,000 %"); // 1e+03 as three digits
    CHECK(percentage(40712.4) == "40,700 %");
    CHECK(percentage(-40752) == "-40,800 %");
    CHECK(percentage(40712.4, 4) == "40,710 %");
    CHECK(percentage(1234.5, 4) == "1,234 %");
    CHECK(percentage(9.996e11) == "1,000,000,000,000 %");
    CHECK(percentage(1e12) == "1e+12 %");
    CHECK(percentage(0.0000123) == "1.23e-05 %");
    CHECK(percentage(HUGE_VAL) == "inf %");
}

TEST_CASE("places have six digits, and three decimals far from the origin", "[base]") {
    CHECK(readable(Vec3{0.5, 1.0 / 3, -12.3456789}) == "0.5 0.333333 -12.3457");
    CHECK(readable(Vec3{691234.25, 5334567.1234, -1000}, ", ") == "691234.25, 5334567.123, -1000");
    CHECK(readable_pair(999999.9999, 1e12) == "1000000, 1e+12");
    CHECK(readable(Vec3{HUGE_VAL, 0, 1e-9}) == "out of range 0 1e-09");
}
