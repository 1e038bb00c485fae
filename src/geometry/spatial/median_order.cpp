#include "geometry/spatial/median_order.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <bit>
#include <span>

namespace facetmill {

namespace {

using Items = std::span<CentredItem>;

/// The axis along which the centres reach farthest.
std::size_t longest_side(Items items) {
    float low[3], high[3];
    for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = high[axis] = items[0].centre[axis];
    for (const auto& item : items)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], item.centre[axis]);
            high[axis] = std::max(high[axis], item.centre[axis]);
        }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    return longest;
}

/// The lowest `half` of the items come first.
void halve(Items items, std::size_t half) {
    const std::size_t axis = longest_side(items);
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [axis](const CentredItem& a, const CentredItem& b) {
                         return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                                 : a.item < b.item;
                     });
}

/// `room` is a power of two, and at least the number of items.
void sort_within(Items items, std::size_t room) {
    for (; items.size() > 1; room /= 2) {
        const std::size_t half = room / 2;
        if (items.size() <= half) continue;
        halve(items, half);
        sort_within(items.subspan(half), half);
        items = items.first(half);
    }
}

} // namespace

void sort_in_median_order(std::vector<CentredItem>& items) {
    // Upper halves one level at a time, those of a level in parallel; then each part by itself.
    constexpr std::size_t small = 8192;
    std::size_t room = std::bit_ceil(std::max<std::size_t>(items.size(), 1));
    const auto part = [&](std::size_t i) {
        return Items(items).subspan(i * room, std::min(room, items.size() - i * room));
    };
    const auto parts = [&] { return (items.size() + room - 1) / room; };
    for (; room > small; room /= 2)
        parallel_for(
            parts(),
            [&](std::size_t i) {
                if (part(i).size() > room / 2) halve(part(i), room / 2);
            },
            1);
    parallel_for(
        parts(), [&](std::size_t i) { sort_within(part(i), room); }, 1);
}

} // namespace facetmill
