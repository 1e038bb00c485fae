#pragma once
// The order in which cells are worked on, and joined: a station for each cell, and for each two to four
// stations below a node of every other level of the tree.

#include "cells/partition.hpp"

#include <functional>

namespace facetmill::cells {

/// What is worked on as one: a leaf of the tree, or what is left of up to four stations below.
struct Station {
    std::uint32_t node = 0, leaf = Tree::no_node;
    std::vector<std::size_t> children;
    std::size_t level = 0;   ///< 0: the root
    std::uint64_t faces = 0; ///< of the mesh as it came
    bool is_leaf() const { return leaf != Tree::no_node; }
};

/// Each after its children; the root is the last.
std::vector<Station> stations_of(const Partition& partition);

std::size_t levels_of(const std::vector<Station>& stations);

/// Settles all stations but the root, each after its children and as many at a time as threads and memory
/// allow. bytes_of(station): what settling it takes, asked when its children are settled, and what may throw.
void settle_below_root(const std::vector<Station>& stations, std::uint64_t memory,
                       const std::function<std::uint64_t(std::size_t)>& bytes_of,
                       const std::function<void(std::size_t)>& settle);

/// What is left of each station, on disk, until it is joined.
class LeftCells {
  public:
    LeftCells(const std::vector<Station>& stations, const std::filesystem::path& scratch)
        : stations_(stations), file_(scratch), left_(stations.size()) {}

    /// Any thread. Throws output (E-WRITE, E-SPACE).
    void put(std::size_t station, const Cell& cell);
    /// The children of the station as one. Any thread. Throws output (E-SCRATCH).
    Cell joined_at(std::size_t station, const Tree& tree) const;
    std::uint64_t vertices_below(std::size_t station) const; ///< of its children together
    std::uint64_t faces_below(std::size_t station) const;

  private:
    struct Left {
        Block block;
        std::uint64_t vertices = 0, faces = 0;
    };
    const std::vector<Station>& stations_;
    BlockFile file_;
    std::vector<Left> left_; ///< [stations]
};

} // namespace facetmill::cells
