#include "support/catch.hpp"

#include "mesh/indices_where.hpp"

#include <atomic>

using namespace facetmill;

TEST_CASE("what is wanted is listed once, ascending, across chunks", "[mesh]") {
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, default_chunk, 3 * default_chunk + 5}) {
        std::atomic<std::size_t> asked = 0;
        const auto third = indices_where(n, [&](Index i) {
            ++asked;
            return i % 3 == 0;
        });
        CHECK(asked == n);
        REQUIRE(third.size() == (n + 2) / 3);
        for (std::size_t i = 0; i < third.size(); ++i) CHECK(third[i] == 3 * i);
        CHECK(indices_where(n, [](Index) { return false; }).empty());
        CHECK(indices_where(n, [](Index) { return true; }).size() == n);
    }
}
