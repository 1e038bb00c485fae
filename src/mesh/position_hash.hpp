#pragma once
// Numbers distinct point positions in the order of their first occurrence: an exact weld without a list of
// all points, for STL. weld_exact() sorts the points instead, which is faster if few are equal.

#include "base/progress.hpp"
#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace facetmill {

/// The bits of a point's three float32, with 0 for -0. Equal points have equal bits, and NaNs too.
using FloatBits = std::array<std::uint32_t, 3>;

/// A well-mixed hash of the coordinates. Products of 128 bits are folded to 64 together with their factors,
/// so that a factor 0 does not cancel the other (after Y. Wang et al., "wyhash", 2019).
[[nodiscard]] inline std::uint64_t place_hash(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    __extension__ using Wide = unsigned __int128;
    const auto mixed = [](std::uint64_t x, std::uint64_t y) {
        const Wide product = Wide{x} * y;
        return x ^ y ^ static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
    };
    constexpr std::uint64_t keys[] = {0xa0761d6478bd642f, 0xe7037ed1a0b428db, 0x8ebc6af09c88c6e3};
    return mixed(mixed(a ^ keys[0], b ^ keys[1]) ^ keys[2], c ^ keys[1]);
}
[[nodiscard]] inline std::uint64_t place_hash(const FloatBits& p) { return place_hash(p[0], p[1], p[2]); }
/// A hash of the point, equal for -0 and 0.
[[nodiscard]] inline std::uint64_t place_hash(const Vec3& p) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    return place_hash(bits(p.x), bits(p.y), bits(p.z));
}

/// A hash table of positions that all threads fill at once. A slot holds a position and its first point. The
/// choice of the slot depends on the threads, its final content does not.
class PositionHash {
  public:
    /// slots: fewer than 2^32. grows: a larger table can replace it when it is full.
    PositionHash(std::size_t slots, bool grows) : slots_(new Slot[slots]), size_(slots), grows_(grows) {
        parallel_for(slots, [&](std::size_t s) { slots_[s].first = none; });
    }

    /// Sets slot[i] to the slot of each point, and bit i of is_first if the point is the first at its
    /// position. Returns false if the table is too full.
    template <class Point>
    bool add(std::vector<Index>& slot, std::vector<std::uint64_t>& is_first, const Point& point) {
        std::atomic<std::size_t> taken = 0;
        std::atomic<bool> full = false;
        std::mutex guard;
        std::vector<Index> displaced; // points that were first until an earlier point came
        ProgressScope::report_next_loop();
        parallel_chunks(slot.size(), [&](std::size_t begin, std::size_t end) {
            if (full.load(std::memory_order_relaxed)) return;
            Chunk chunk;
            constexpr std::size_t block = 32; // number of points whose slots are prefetched
            std::array<std::pair<FloatBits, Index>, block> next;
            for (std::size_t at = begin; at < end; at += block) {
                const std::size_t count = std::min(block, end - at);
                for (std::size_t k = 0; k < count; ++k) {
                    next[k].first = point(at + k);
                    next[k].second = home(place_hash(next[k].first));
                    __builtin_prefetch(&slots_[next[k].second]);
                }
                for (std::size_t k = 0; k < count; ++k) {
                    const std::size_t i = at + k;
                    slot[i] = put(static_cast<Index>(i), next[k].second, next[k].first, chunk);
                    if (slot[i] == none) return full.store(true, std::memory_order_relaxed);
                    is_first[i / 64] |= std::uint64_t{chunk.was_first} << i % 64;
                }
            }
            if constexpr (requires { point.done(begin, end); }) point.done(begin, end);
            if ((taken += chunk.taken) > size_ / 4 * 3 && grows_) full.store(true, std::memory_order_relaxed);
            if (chunk.displaced.empty()) return;
            const std::lock_guard lock(guard);
            displaced.insert(displaced.end(), chunk.displaced.begin(), chunk.displaced.end());
        });
        for (const Index i : displaced) is_first[i / 64] &= ~(std::uint64_t{1} << i % 64);
        return !full;
    }

    /// The first point at the position of a slot, or its replacement value.
    Index& first(Index slot) { return slots_[slot].first; }
    const FloatBits& key(Index slot) const { return slots_[slot].key; }

  private:
    struct Slot {
        Index first; ///< none: the slot is free; busy: another thread is writing the key
        FloatBits key;
    };
    static constexpr Index busy = none - 1;

    /// The state of a thread for the points of a chunk.
    struct Chunk {
        std::size_t taken = 0;  ///< number of taken slots
        bool was_first = false; ///< whether the last point was the first at its position so far
        std::vector<Index> displaced;
    };

    Index home(std::uint64_t hash) const { return static_cast<Index>((hash >> 32) * size_ >> 32); }

    /// The slot of position p of point i, at or after the given slot; none if the table is full.
    Index put(Index i, Index slot, const FloatBits& p, Chunk& chunk) {
        for (std::size_t probes = 0; probes < size_; ++probes) {
            std::atomic_ref<Index> first(slots_[slot].first);
            Index there = first.load(std::memory_order_acquire);
            if (there == none && first.compare_exchange_strong(there, busy, std::memory_order_acquire)) {
                slots_[slot].key = p;
                first.store(i, std::memory_order_release);
                ++chunk.taken;
                chunk.was_first = true;
                return slot;
            }
            while (there == busy) {
                std::this_thread::yield();
                there = first.load(std::memory_order_acquire);
            }
            if (is_same(slots_[slot].key, p)) {
                chunk.was_first = lower(first, there, i);
                if (chunk.was_first) chunk.displaced.push_back(there);
                return slot;
            }
            if (++slot == size_) slot = 0;
        }
        return none;
    }

    /// Equals a == b, but without a call of memcmp.
    static bool is_same(const FloatBits& a, const FloatBits& b) {
        return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
    }

    /// Makes i the first if it is lower than the current first; returns whether it was.
    static bool lower(std::atomic_ref<Index> first, Index& there, Index i) {
        while (i < there)
            if (first.compare_exchange_weak(there, i, std::memory_order_relaxed)) return true;
        return false;
    }

    std::unique_ptr<Slot[]> slots_;
    std::size_t size_;
    bool grows_;
};

/// Sets number[i] to the number of the position of point(i), for all i below number.size() < 2^32 - 2.
/// Positions are numbered in the order of their first points. Equal keys are the same position.
/// begin(places) receives their count. Unless it returns false, first(place, i, key) is then called for the
/// first point of each position, in parallel, with the key of one of its points. point.done(begin, end), if
/// it exists, is called after the first visit of these points. `expected` is the approximate number of
/// positions, which saves memory. Returns the number of positions. The result does not depend on the number
/// of threads.
template <class Point, class Begin, class First>
std::size_t number_places(std::vector<Index>& number, std::size_t expected, const Point& point, Begin&& begin,
                          First&& first) {
    const std::size_t n = number.size(), most = std::min(2 * n + 1, std::size_t{none});
    std::size_t slots = std::min(most, expected / 5 * 8 + 64);
    PositionHash table(slots, slots < most);
    std::vector<std::uint64_t> is_first((n + 63) / 64);
    static_assert(default_chunk % 64 == 0, "a word of flags belongs to one chunk");
    while (!table.add(number, is_first, point)) {
        slots = std::min(most, 4 * slots);
        table = PositionHash(1, true); // frees the old table before allocating a new one
        table = PositionHash(slots, slots < most);
        std::fill(is_first.begin(), is_first.end(), 0);
    }

    std::vector<Index> before((n + default_chunk - 1) / default_chunk);
    for (std::size_t word = 0; word < is_first.size(); ++word)
        before[64 * word / default_chunk] += static_cast<Index>(std::popcount(is_first[word]));
    const Index places = exclusive_scan(before);
    if (!begin(std::size_t{places})) return places;
    parallel_chunks(n, [&](std::size_t from, std::size_t to) {
        Index place = before[from / default_chunk];
        for (std::size_t word = from / 64; 64 * word < to; ++word)
            for (std::uint64_t left = is_first[word]; left != 0; left &= left - 1) {
                const std::size_t i = 64 * word + static_cast<std::size_t>(std::countr_zero(left));
                table.first(number[i]) = place;
                first(place++, i, table.key(number[i]));
            }
    });
    parallel_for(n, [&](std::size_t i) { number[i] = table.first(number[i]); });
    return places;
}

} // namespace facetmill
