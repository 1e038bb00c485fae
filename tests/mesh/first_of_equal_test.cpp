#include "mesh/first_of_equal.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"

#include <algorithm>

using namespace facetmill;

TEST_CASE("each item has the first that equals it, however they are hashed", "[mesh]") {
    for (const std::size_t count : {0, 1, 2, 3, 64, 65, 1000})
        for (const std::uint64_t values : {1, 7, 500, 1'000'000})
            for (const bool hashes : {true, false}) {
                std::vector<std::uint64_t> items(count);
                for (std::size_t i = 0; i < count; ++i) items[i] = hashed(values, i) % values;
                const auto first = first_of_equal(
                    count, [&](Index i) { return hashes ? hashed(1, items[i]) : 5; },
                    [&](Index i, Index j) { return items[i] == items[j]; });
                REQUIRE(first.size() == count);
                for (std::size_t i = 0; i < count; ++i)
                    CHECK(items.begin() + first[i] == std::find(items.begin(), items.end(), items[i]));
            }
}
