#pragma once
// What leaves of a tree have in common, found by sorting on disk.

#include "cells/partition/number_owners.hpp"
#include "cells/partition/tree.hpp"
#include "cells/storage/block_file.hpp"

#include <functional>

namespace facetmill::cells {

/// Keys that several leaves have.
class Borders {
  public:
    /// In place of a depth: only one leaf has the key.
    static constexpr std::uint8_t inner = UINT8_MAX;

    /// keys_of(leaf): its keys, each once. estimate: of their number, of all leaves together. memory: bytes,
    /// for everything that the process does. Throws output (E-WRITE, E-SPACE, E-SCRATCH).
    Borders(const Tree& tree, const std::filesystem::path& scratch, std::uint64_t memory,
            std::uint64_t estimate, const std::function<std::vector<std::uint64_t>(std::uint32_t)>& keys_of);

    /// The same of keys that are numbers. leaf_of: see NumberOwners::leaves.
    Borders(const Tree& tree, const std::filesystem::path& scratch, std::uint64_t memory,
            const NumberOwners& owners, const std::vector<std::uint32_t>& leaf_of);

    /// As they were stored, of so many keys.
    Borders(std::uint64_t count, SpillFile shared) : count_(count), shared_(std::move(shared)) {}

    /// Puts what was found into a file with a name, where it is read from then on: see SpillFile::stored.
    void store(const std::filesystem::path& file, bool sync, std::vector<Block>& blocks);

    std::uint64_t count() const { return count_; } ///< of keys, each once
    /// For keys of the leaf: the depth of the node that all leaves with this key have in common, or inner.
    /// Any thread. Throws output (E-SCRATCH).
    std::vector<std::uint8_t> homes(std::uint32_t leaf, const std::vector<std::uint64_t>& keys) const;

  private:
    std::uint64_t share(const Tree& tree, const std::vector<Owned>& all);

    std::uint64_t count_ = 0;
    SpillFile shared_; ///< [leaves] keys and depths
};

} // namespace facetmill::cells
