#pragma once
// Which lists of faces have a vertex, where vertices have numbers: seen while the faces are put into lists.

#include "cells/storage/block_file.hpp"

#include <algorithm>

namespace facetmill::cells {

/// A key of a leaf.
struct Owned {
    std::uint64_t key;
    std::uint32_t leaf;
    bool operator==(const Owned&) const = default;
    bool operator<(const Owned& other) const {
        return key != other.key ? key < other.key : leaf < other.leaf;
    }
};

/// Into how many buckets keys are divided so that each fits into memory. estimate: of their number.
std::uint64_t buckets_of_keys(std::uint64_t estimate, std::uint64_t memory);
std::uint64_t bucket_of_key(std::uint64_t key, std::uint64_t buckets);

class NumberOwners {
  public:
    static constexpr std::uint32_t nobody = UINT32_MAX;

    /// Whether memory is enough for so many numbers, beside what dividing a leaf takes, which is the same
    /// for any memory.
    static bool fits(std::uint64_t numbers, std::uint64_t memory) {
        constexpr std::uint64_t dividing = std::uint64_t{64} << 20;
        const std::uint64_t third = memory / 3;
        return numbers * sizeof(std::uint32_t) <= std::max(memory / 6, third - std::min(third, dividing));
    }
    /// Of numbers below `numbers`. buckets: see buckets_of_keys. memory: bytes, for everything that the
    /// process does. Throws output (E-WRITE, E-SPACE).
    NumberOwners(std::uint64_t numbers, const std::filesystem::path& scratch, std::uint64_t buckets,
                 std::uint64_t memory);
    /// A face of the list has the number.
    void add(std::uint32_t number, std::uint32_t list) {
        std::uint32_t& first = first_[number];
        if (first == nobody)
            first = list;
        else if (first != list)
            add_another(number, list);
    }
    /// ... which may have been in another list before, that is none of leaf_of below.
    void add_another(std::uint32_t number, std::uint32_t list);
    void finish() { others_.flush(); }

    std::uint64_t count() const; ///< of numbers that some list has
    std::size_t buckets() const { return others_.lists(); }
    /// The leaves of those numbers of the bucket that several lists have, each once, in order. leaf_of:
    /// [lists] the leaf that has the list, or nobody.
    std::vector<Owned> leaves(std::size_t bucket, const std::vector<std::uint32_t>& leaf_of) const;

  private:
    struct Other {
        std::uint32_t number, list;
    };
    std::vector<std::uint32_t> first_; ///< [numbers] a list that has it
    std::vector<Other> latest_;        ///< that were added, so that few are added twice
    SpillFile others_;                 ///< by bucket
};

} // namespace facetmill::cells
