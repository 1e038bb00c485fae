#pragma once
// Records the lists of faces that contain each numbered vertex, while the faces are distributed to lists.

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

/// The number of buckets of keys such that each fits into memory. estimate: the number of keys.
[[nodiscard]] std::uint64_t buckets_of_keys(std::uint64_t estimate, std::uint64_t memory);
[[nodiscard]] std::uint64_t bucket_of_key(std::uint64_t key, std::uint64_t buckets);

class NumberOwners {
  public:
    static constexpr std::uint32_t nobody = UINT32_MAX;

    /// Whether memory suffices for `numbers` numbers, besides the fixed memory for dividing a leaf.
    static bool fits(std::uint64_t numbers, std::uint64_t memory) {
        constexpr std::uint64_t dividing = std::uint64_t{64} << 20;
        const std::uint64_t third = memory / 3;
        return numbers * sizeof(std::uint32_t) <= std::max(memory / 6, third - std::min(third, dividing));
    }
    /// For numbers below `numbers`. buckets: see buckets_of_keys. memory: bytes for the whole process.
    /// Throws an output error (E-WRITE, E-SPACE).
    NumberOwners(std::uint64_t numbers, const std::filesystem::path& scratch, std::uint64_t buckets,
                 std::uint64_t memory);
    /// Records that a face of the list has the number.
    void add(std::uint32_t number, std::uint32_t list) {
        std::uint32_t& first = first_[number];
        if (first == nobody)
            first = list;
        else if (first != list)
            add_another(number, list);
    }
    /// Records a further list, if the number was first in another list.
    void add_another(std::uint32_t number, std::uint32_t list);
    void finish() { others_.flush(); }

    std::uint64_t count() const; ///< the count of numbers in at least one list
    std::size_t buckets() const { return others_.lists(); }
    /// The distinct leaves, sorted, of those numbers in the bucket that several lists have. leaf_of: [lists]
    /// the leaf of the list, or nobody.
    std::vector<Owned> leaves(std::size_t bucket, const std::vector<std::uint32_t>& leaf_of) const;

  private:
    struct Other {
        std::uint32_t number, list;
    };
    std::vector<std::uint32_t> first_; ///< [numbers] a list with the number
    std::vector<Other> latest_;        ///< recently added entries, to avoid most duplicates
    SpillFile others_;                 ///< further entries by bucket
};

} // namespace facetmill::cells
