#include "report/deviation_view.hpp"
#include "support/catch.hpp"

using namespace facetmill;
using report::colour_limit;

TEST_CASE("colours tell most of the surface apart, and not only what is far off", "[report]") {
    CHECK(colour_limit({}, 7, 0) == 7);
    CHECK(colour_limit({0, 0, 0}, 0, 0) == 0);
    CHECK(colour_limit({0, 0, 0}, 0, 1e6) == 1);
    std::vector<float> even;
    for (int i = -100; i <= 100; ++i) even.push_back(static_cast<float>(i));
    CHECK(colour_limit(even, 100, 0) == 100);
    std::vector<float> one_off = even;
    one_off.insert(one_off.end(), 2, -5000.0f); // one in a hundred
    CHECK(colour_limit(one_off, 5000, 0) == 100);
    std::vector<float> cap(1000, 0.5f); // a cut that was closed: 4 % of it
    cap.insert(cap.end(), 40, -43.0f);
    CHECK(colour_limit(cap, 43, 0) == 2);
    std::vector<float> half(1000, 0.5f); // half of it is another surface
    half.insert(half.end(), 1000, -43.0f);
    CHECK(colour_limit(half, 43, 0) == 43);
}
