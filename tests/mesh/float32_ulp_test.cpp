#include "support/catch.hpp"

#include "mesh/float32_ulp.hpp"

using namespace facetmill;

TEST_CASE("a float32 ulp is the distance to the next float at the largest coordinate", "[mesh]") {
    const auto at = [](double x) { return float32_ulp({{0, 0, 0}, {0.5 * x, x, 0}}); };
    for (const float x : {1.0F, 1.5F, 1e9F, 3e-5F, 1e-44F, std::nextafter(4.0F, 0.0F)}) {
        INFO(x);
        CHECK(at(x) == static_cast<double>(std::nextafter(x, HUGE_VALF)) - static_cast<double>(x));
    }
    CHECK(float32_ulp({{-8, 0, 0}, {1, 1, 1}}) == 0x1p-20);
    CHECK(float32_ulp({{0, 0, 0}, {0, 0, 0}}) == 0);
    CHECK(float32_ulp({}) == 0);
}
