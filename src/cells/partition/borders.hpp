#pragma once
// Keys that several leaves of a tree share, found by sorting on disk.

#include "cells/partition/number_owners.hpp"
#include "cells/partition/tree.hpp"
#include "cells/storage/block_file.hpp"

#include <functional>

namespace facetmill::cells {

/// The keys that several leaves have.
class Borders {
  public:
    /// Replaces a depth in the key of a point that only a single leaf has.
    static constexpr std::uint8_t inner = UINT8_MAX;

    /// keys_of(leaf): the leaf's distinct keys. estimate: the total number of keys of all leaves. memory:
    /// bytes for the whole process. Throws an output error (E-WRITE, E-SPACE, E-SCRATCH).
    Borders(const Tree& tree, const std::filesystem::path& scratch, std::uint64_t memory,
            std::uint64_t estimate, const std::function<std::vector<std::uint64_t>(std::uint32_t)>& keys_of);

    /// Finds borders for keys that are numbers. leaf_of: see NumberOwners::leaves.
    Borders(const Tree& tree, const std::filesystem::path& scratch, std::uint64_t memory,
            const NumberOwners& owners, const std::vector<std::uint32_t>& leaf_of);

    /// Restores stored borders with `count` keys.
    Borders(std::uint64_t count, SpillFile shared) : count_(count), shared_(std::move(shared)) {}

    /// Moves the data into a named file and reads it from that file afterwards: see SpillFile::stored.
    void store(const std::filesystem::path& file, bool sync, std::vector<Block>& blocks);

    std::uint64_t count() const { return count_; } ///< number of distinct keys
    /// The depth, for each key of the leaf, of the lowest common node of all leaves with the key, or inner.
    /// Thread-safe. Throws an output error (E-SCRATCH).
    std::vector<std::uint8_t> homes(std::uint32_t leaf, const std::vector<std::uint64_t>& keys) const;

  private:
    std::uint64_t share(const Tree& tree, const std::vector<Owned>& all);

    std::uint64_t count_ = 0;
    SpillFile shared_; ///< [leaves] keys and depths
};

} // namespace facetmill::cells
