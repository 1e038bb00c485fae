#include "support/catch.hpp"

#include "base/parallel.hpp"

#include <algorithm>

using namespace facetmill;

TEST_CASE("items are sorted by their keys, equal ones in their order, however many there are", "[base]") {
    struct Item {
        std::uint64_t key;
        std::size_t number;
        bool operator==(const Item&) const = default;
    };
    for (const std::size_t count : {0, 1, 2, 255, 256, 257, 5000, 70000})
        for (const int bits : {3, 11, 33, 64}) {
            std::vector<Item> items(count);
            std::uint64_t state = 1; // Knuth's MMIX generator; its high bits are the good ones
            for (std::size_t i = 0; i < count; ++i) {
                state = state * 6364136223846793005ULL + 1442695040888963407ULL;
                items[i] = {state >> (64 - bits), i};
            }
            std::vector<Item> expected = items;
            std::stable_sort(expected.begin(), expected.end(),
                             [](const Item& a, const Item& b) { return a.key < b.key; });
            radix_sort(
                items, [](const Item& i) { return i.key; }, bits);
            CHECK(items == expected);
        }
}
