#pragma once
// Points at exactly the same place get one number, in the order of their first occurrence: a weld that needs
// no list of all points, for STL. weld_exact() sorts them instead, which is faster where few are equal.

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <atomic>
#include <bit>

namespace facetmill {

/// The bits of a point's three float32, 0 for -0: equal where the point is, also where it is not a number.
using FloatBits = std::array<std::uint32_t, 3>;

/// A well-mixed number of the coordinates (products of 128 bits folded to 64, after
/// Y. Wang et al., "wyhash", 2019).
inline std::uint64_t place_hash(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    __extension__ using Wide = unsigned __int128;
    const auto mixed = [](std::uint64_t x, std::uint64_t y) {
        const Wide product = Wide{x} * y;
        return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
    };
    constexpr std::uint64_t keys[] = {0xa0761d6478bd642f, 0xe7037ed1a0b428db, 0x8ebc6af09c88c6e3};
    return mixed(mixed(a ^ keys[0], b ^ keys[1]) ^ keys[2], c ^ keys[1]);
}
inline std::uint64_t place_hash(const FloatBits& p) { return place_hash(p[0], p[1], p[2]); }

/// A hash table of places that all threads fill at once. A slot holds the first point at its place; which
/// slot that is depends on the threads, what it holds in the end does not.
class PlaceTable {
  public:
    /// Not more than 2^32 slots; `grows`: a larger one can be had when it fills.
    PlaceTable(std::size_t slots, bool grows)
        : first_(slots, none), shift_(64 - std::countr_zero(slots)), grows_(grows) {}

    /// Sets slot[i] to the slot of each of the points; false when the table is too full to go on.
    template <class Point>
    bool add(std::vector<Index>& slot, const Point& point) {
        std::atomic<std::size_t> taken = 0;
        std::atomic<bool> full = false;
        Share::loop_tells();
        parallel_chunks(slot.size(), [&](std::size_t begin, std::size_t end) {
            if (full.load(std::memory_order_relaxed)) return;
            std::size_t mine = 0;
            constexpr std::size_t block = 32; // whose slots are asked from memory before they are needed
            std::array<Index, block> homes{};
            for (std::size_t at = begin; at < end; at += block) {
                const std::size_t count = std::min(block, end - at);
                for (std::size_t k = 0; k < count; ++k) {
                    homes[k] = home(hash_of(point(at + k), at + k));
                    __builtin_prefetch(&first_[homes[k]]);
                }
                for (std::size_t k = 0; k < count; ++k) {
                    if (!put(static_cast<Index>(at + k), homes[k], point, mine))
                        return full.store(true, std::memory_order_relaxed);
                    slot[at + k] = homes[k];
                }
            }
            if ((taken += mine) > first_.size() / 4 * 3 && grows_)
                full.store(true, std::memory_order_relaxed);
        });
        return !full;
    }

    Index& operator[](std::size_t slot) { return first_[slot]; }

  private:
    /// What is not a number equals nothing, not even itself: its place in the file keeps it from others like
    /// it.
    template <class P>
    static std::uint64_t hash_of(const P& p, std::size_t i) {
        return p == p ? place_hash(p) : place_hash(i, 0, 0);
    }

    Index home(std::uint64_t hash) const {
        return first_.size() > 1 ? static_cast<Index>(hash >> shift_) : 0;
    }

    /// Goes on from the slot to that of point i's place; false when there is no room for it.
    template <class Point>
    bool put(Index i, Index& slot, const Point& point, std::size_t& taken) {
        const auto mask = static_cast<Index>(first_.size() - 1);
        const auto p = point(i);
        for (std::size_t probes = 0; probes < first_.size(); ++probes, slot = (slot + 1) & mask) {
            std::atomic_ref<Index> first(first_[slot]);
            Index there = first.load(std::memory_order_relaxed);
            if (there == none && first.compare_exchange_strong(there, i, std::memory_order_relaxed)) {
                ++taken;
                return true;
            }
            if (!(point(there) == p)) continue;
            while (i < there && !first.compare_exchange_weak(there, i, std::memory_order_relaxed)) {
            }
            return true;
        }
        return false;
    }

    std::vector<Index> first_; ///< [slots, a power of two] -> point; none: free
    int shift_;
    bool grows_;
};

/// Sets number[i] to the number of the place of point(i), for all i below number.size(): places are numbered
/// in the order of their first points (those that are equal are at one place). begin(places) is
/// called when their count is known; unless it gives false, first(place, i) is then called for the first
/// point of each, in parallel. `expected` tells about how many places there are, which saves memory. Returns
/// the count of places. Same result for any number of threads.
template <class Point, class Begin, class First>
std::size_t number_places(std::vector<Index>& number, std::size_t expected, const Point& point, Begin&& begin,
                          First&& first) {
    const std::size_t n = number.size(), most = std::min(std::bit_ceil(2 * n + 1), std::size_t{1} << 32);
    std::size_t slots = std::min(most, std::bit_ceil(2 * expected + 1));
    PlaceTable table(slots, slots < most);
    while (!table.add(number, point)) {
        slots = std::min(most, 4 * slots);
        table = PlaceTable(slots, slots < most);
    }

    const std::size_t chunks = (n + default_chunk - 1) / default_chunk;
    std::vector<Index> before(chunks);
    std::vector<std::uint64_t> is_first((n + 63) / 64);
    static_assert(default_chunk % 64 == 0, "a word of flags belongs to one chunk");
    parallel_chunks(n, [&](std::size_t from, std::size_t to) {
        Index count = 0;
        for (std::size_t i = from; i < to; ++i) {
            const bool is = table[number[i]] == i;
            is_first[i / 64] |= std::uint64_t{is} << i % 64;
            count += is;
        }
        before[from / default_chunk] = count;
    });
    const Index places = exclusive_scan(before);
    if (!begin(std::size_t{places})) return places;
    parallel_chunks(n, [&](std::size_t from, std::size_t to) {
        Index place = before[from / default_chunk];
        for (std::size_t word = from / 64; 64 * word < to; ++word)
            for (std::uint64_t left = is_first[word]; left != 0; left &= left - 1) {
                const std::size_t i = 64 * word + static_cast<std::size_t>(std::countr_zero(left));
                table[number[i]] = place;
                first(place++, i);
            }
    });
    parallel_for(n, [&](std::size_t i) { number[i] = table[number[i]]; });
    return places;
}

} // namespace facetmill
