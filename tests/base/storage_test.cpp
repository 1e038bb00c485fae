#include "base/storage.hpp"

#include "support/catch.hpp"
#include <numeric>

using namespace facetmill;

TEST_CASE("a large array grows as resize grows it: what was there stays, what is new is zero", "[base]") {
    for (const std::size_t n : {std::size_t{0}, std::size_t{5}, std::size_t{3} << 20}) {
        std::vector<int> v(4);
        std::iota(v.begin(), v.end(), 1);
        resize_large(v, n);
        REQUIRE(v.size() == n);
        for (std::size_t i = 0; i < n; ++i)
            if (v[i] != (i < 4 ? static_cast<int>(i) + 1 : 0)) FAIL("element " << i << " is " << v[i]);
    }
}

TEST_CASE("asking for pages changes no contents", "[base]") {
    std::vector<int> v((std::size_t{3} << 20) + 7);
    std::iota(v.begin(), v.end(), 0);
    prefault(v.data() + 3, (v.size() - 3) * sizeof(int)); // not at a page's beginning
    for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != static_cast<int>(i)) FAIL("element " << i << " is " << v[i]);
}
