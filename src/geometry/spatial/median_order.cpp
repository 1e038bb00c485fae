#include "geometry/spatial/median_order.hpp"

#include "base/math/simd.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

namespace facetmill {

namespace {

using Items = std::span<CentredItem>;

/// The axis along which the extent of the centres is largest.
std::size_t longest_side(Items items) {
    static_assert(sizeof(CentredItem) == sizeof(Float4));
    const auto whole = [](const CentredItem& item) { // the last lane is the item's number and is ignored
        Float4 four;
        std::memcpy(&four, &item, sizeof four);
        return four;
    };
    Float4 low = whole(items[0]), high = low;
    for (const auto& item : items) {
        low = lesser(low, whole(item));
        high = greater(high, whole(item));
    }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    return longest;
}

/// Compares by the coordinate along an axis, then by number.
class Before {
  public:
    explicit Before(std::size_t axis) : axis_(axis) {}
    bool operator()(const CentredItem& a, const CentredItem& b) const {
        const float x = a.centre[axis_], y = b.centre[axis_];
        return (x < y) |
               ((x == y) &
                (a.item < b.item)); // without a branch, because it would be mispredicted half the time
    }

  private:
    std::size_t axis_;
};

std::size_t middle_of(Items items, std::size_t a, std::size_t b, std::size_t c, const Before& before) {
    if (before(items[b], items[a])) std::swap(a, b);
    if (before(items[c], items[b])) b = before(items[c], items[a]) ? a : c;
    return b;
}

/// The approximate median of the items.
std::size_t pivot_of(Items items, const Before& before) {
    const std::size_t n = items.size(), step = n / 8;
    if (n < 128) return middle_of(items, 0, n / 2, n - 1, before);
    return middle_of(items, middle_of(items, 0, step, 2 * step, before),
                     middle_of(items, 3 * step, 4 * step, 5 * step, before),
                     middle_of(items, 6 * step, 7 * step, n - 1, before), before);
}

/// Moves the items before the pivot to the front, followed by the pivot; returns its index. Every item is
/// moved, so that no branch can be mispredicted (N. Lomuto's partition, without branches).
std::size_t parted(Items items, std::size_t pivot, const Before& before) {
    std::swap(items[pivot], items.back());
    const CentredItem last = items.back();
    std::size_t front = 0;
    for (std::size_t i = 0; i + 1 < items.size(); ++i) {
        const CentredItem item = items[i];
        items[i] = items[front];
        items[front] = item;
        front += before(item, last);
    }
    std::swap(items[front], items.back());
    return front;
}

/// Moves the lowest `half` of the items to the front.
void halve(Items items, std::size_t half) {
    const Before before(longest_side(items));
    constexpr std::size_t few = 8;
    for (int tries = 4 * std::bit_width(items.size()); items.size() > few; --tries) {
        if (tries == 0) { // all pivots were bad
            std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                             before);
            return;
        }
        const std::size_t at = parted(items, pivot_of(items, before), before);
        if (at == half) return;
        if (at > half) {
            items = items.first(at);
        } else {
            items = items.subspan(at + 1);
            half -= at + 1;
        }
    }
    for (std::size_t i = 1; i < items.size(); ++i)
        for (std::size_t k = i; k > 0 && before(items[k], items[k - 1]); --k)
            std::swap(items[k], items[k - 1]);
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
    // Sorts the upper halves one level at a time, all parts of a level in parallel; then each part
    // separately.
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
