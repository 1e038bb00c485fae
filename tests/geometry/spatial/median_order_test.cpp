#include "support/catch.hpp"

#include "geometry/spatial/median_order.hpp"
#include "parallel/parallel.hpp"
#include "support/meshes.hpp"

#include <algorithm>

using namespace facetmill;

namespace {

std::vector<CentredItem> random_items(std::size_t count) {
    std::vector<CentredItem> items(count);
    for (std::size_t i = 0; i < count; ++i) {
        items[i].item = static_cast<Index>(i);
        for (std::size_t axis = 0; axis < 3; ++axis) // few different coordinates: many are equal
            items[i].centre[axis] =
                static_cast<float>(static_cast<int>(test::between(0, 40, 8, 3 * i + axis)));
    }
    return items;
}

/// Whether a plane across some axis has the first `half` of the items below or on it and the rest above or
/// on.
bool is_parted(const CentredItem* items, std::size_t half, std::size_t count) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto below = [axis](const CentredItem& a, const CentredItem& b) {
            return a.centre[axis] < b.centre[axis];
        };
        if (std::max_element(items, items + half, below)->centre[axis] <=
            std::min_element(items + half, items + count, below)->centre[axis])
            return true;
    }
    return false;
}

std::vector<Index> numbers(const std::vector<CentredItem>& items) {
    std::vector<Index> result;
    for (const auto& item : items) result.push_back(item.item);
    return result;
}

} // namespace

TEST_CASE("runs of 2^k items are separated from the next by a plane", "[geometry]") {
    for (const std::size_t count : {0, 1, 2, 3, 5, 64, 1000, 40000}) {
        auto items = random_items(count);
        sort_in_median_order(items);
        auto found = numbers(items);
        std::sort(found.begin(), found.end());
        for (std::size_t i = 0; i < count; ++i) REQUIRE(found[i] == i);
        for (std::size_t half = 1; half < count; half *= 2)
            for (std::size_t begin = 0; begin + half < count; begin += 2 * half)
                REQUIRE(is_parted(&items[begin], half, std::min(2 * half, count - begin)));
    }
}

TEST_CASE("the median order is one, whatever the order before and the number of threads", "[geometry]") {
    auto items = random_items(30000), reversed = items;
    std::reverse(reversed.begin(), reversed.end());
    sort_in_median_order(items);
    set_threads(1);
    sort_in_median_order(reversed);
    set_threads(0);
    CHECK(numbers(items) == numbers(reversed));
}
