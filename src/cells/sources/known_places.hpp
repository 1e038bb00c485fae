#pragma once
// Numbers of recent positions within a memory limit. So files that repeat each vertex for each of its faces
// get most vertices only once.

#include "base/math/random.hpp"
#include "mesh/mesh.hpp"

#include <array>

namespace facetmill::cells {

/// The bits of three float32; -0 differs from 0.
using PlaceBits = std::array<std::uint32_t, 3>;

class KnownPositions {
  public:
    /// memory: the limit in bytes.
    explicit KnownPositions(std::size_t memory) : memory_(memory), table_(least) {}

    /// The number of the position, or `next` for a new position. When memory runs out, the table is cleared,
    /// so a position may get a second number.
    std::uint32_t number(const PlaceBits& place, std::uint32_t next) {
        if (4 * (count_ + 1) > 3 * table_.size()) make_room();
        Entry& entry = slot_of(place);
        if (entry.number == none) {
            entry = {place, next};
            ++count_;
        }
        return entry.number;
    }
    /// Whether every position has a single number.
    bool are_all() const { return !forgot_; }

  private:
    static constexpr std::size_t least = 1024;
    struct Entry {
        PlaceBits place{};
        std::uint32_t number = none;
    };

    /// The entry of the position, or the empty slot for it.
    Entry& slot_of(const PlaceBits& place) {
        const std::uint64_t two = std::uint64_t{place[0]} << 32 | place[1];
        std::size_t slot = hashed(hashed(0, two), place[2]) & (table_.size() - 1);
        while (table_[slot].number != none && table_[slot].place != place)
            slot = (slot + 1) & (table_.size() - 1);
        return table_[slot];
    }

    void make_room() {
        const std::size_t larger = 2 * table_.size();
        if ((larger + table_.size()) * sizeof(Entry) > memory_) { // both tables exist during the copy
            table_.assign(table_.size(), {});
            count_ = 0;
            forgot_ = true;
            return;
        }
        std::vector<Entry> old(larger);
        table_.swap(old);
        for (const Entry& entry : old)
            if (entry.number != none) slot_of(entry.place) = entry;
    }

    std::size_t memory_, count_ = 0;
    std::vector<Entry> table_; ///< size is a power of two
    bool forgot_ = false;
};

} // namespace facetmill::cells
