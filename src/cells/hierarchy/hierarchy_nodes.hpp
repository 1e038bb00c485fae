#pragma once
// The order in which cells are worked on, and joined: a station for each cell, or a few beside each other,
// and for each two to four stations below a node of every other level of the tree.

#include "cells/partition/partition.hpp"

#include <functional>

namespace facetmill::cells {

/// What is worked on as one: a leaf of the tree, or several, or what is left of up to four stations below.
struct Station {
    std::uint32_t node = 0;
    std::uint32_t leaf = Tree::no_node, end_leaf = Tree::no_node; ///< from the first to before the last
    std::vector<std::size_t> children;
    std::size_t level = 0;   ///< 0: the root
    std::uint64_t faces = 0; ///< of the mesh as it came
    bool is_leaf() const { return leaf != Tree::no_node; }
};

/// Each after its children; the root is the last.
std::vector<Station> hierarchy_nodes_of(const Partition& partition);
/// The same, but that all leaves below a node are one station where they have at most so many faces together,
/// and that it is at the root, not below, where the tree's height makes two stations out of four.
std::vector<Station> hierarchy_nodes_of(const Partition& partition, std::uint64_t together);

std::size_t levels_of(const std::vector<Station>& hierarchy_nodes);

/// Which stations a job that simplifies settles: [stations], each with all below it. Jobs have about as many
/// faces, and what is above those of all jobs is left to the last run.
std::vector<std::uint8_t> hierarchy_nodes_of_job(const std::vector<Station>& hierarchy_nodes,
                                                 const CellJob& job);

/// Settles these stations, none of them the root, each after its children and as many at a time as threads
/// and memory allow. wanted: [stations]. bytes_of(station): what settling it takes, asked when its children
/// are settled, and what may throw.
void settle_below_root(const std::vector<Station>& hierarchy_nodes, const std::vector<std::uint8_t>& wanted,
                       std::uint64_t memory, const std::function<std::uint64_t(std::size_t)>& bytes_of,
                       const std::function<void(std::size_t)>& settle);

/// What was done at a station, and below it.
struct StationWork {
    double error = 0;
    double area = 0; ///< of the mesh as it came
    std::size_t collapses = 0, turned = 0;
};

/// What is left of each station, on disk, until it is joined.
class LeftCells {
  public:
    /// kept: in files of means.kept, where there is such a folder.
    LeftCells(const std::vector<Station>& hierarchy_nodes, const CellResources& means, bool kept);

    /// Takes up what was kept with this key of these stations, each with all below it. Returns which of them
    /// are still to be settled: [stations] not those that are there, nor those below them. others_go: what
    /// was kept with another key is removed.
    std::vector<std::uint8_t> take_up(const std::vector<std::uint8_t>& among, bool others_go);
    /// Any thread. Throws output (E-WRITE, E-SPACE).
    void put(std::size_t station, Cell cell, const StationWork& work = {});
    const StationWork& work(std::size_t station) const { return left_[station].work; }
    /// The children of the station as one. Any thread. Throws output (E-SCRATCH).
    Cell joined_at(std::size_t station, const Tree& tree) const;
    std::uint64_t vertices_below(std::size_t station) const; ///< of its children together
    std::uint64_t faces_below(std::size_t station) const;

  private:
    struct Left {
        Block block; ///< of file_, where it is not kept
        std::uint64_t vertices = 0, faces = 0;
        StationWork work;
    };
    io::Bytes bytes_of(std::size_t station) const;
    CellFolder::Found take(std::size_t station);

    const std::vector<Station>& hierarchy_nodes_;
    std::shared_ptr<const CellFolder> kept_; ///< or none
    std::string key_;
    BlockFile file_;
    std::vector<Left> left_; ///< [stations]
};

} // namespace facetmill::cells
