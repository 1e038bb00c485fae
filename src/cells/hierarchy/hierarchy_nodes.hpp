#pragma once
// The order in which cells are processed and joined. Each cell, or a few adjacent cells, is a station. Every
// second level of the tree joins two to four stations into a station.

#include "cells/partition/partition.hpp"

#include <functional>

namespace facetmill::cells {

/// A unit of work: a leaf of the tree, several leaves, or the joined results of up to four stations below.
struct Station {
    std::uint32_t node = 0;
    std::uint32_t leaf = Tree::no_node, end_leaf = Tree::no_node; ///< from first to one past last
    std::vector<std::size_t> children;
    std::size_t level = 0;   ///< 0: the root
    std::uint64_t faces = 0; ///< of the input mesh
    bool is_leaf() const { return leaf != Tree::no_node; }
};

/// Each station follows its children; the root is last.
[[nodiscard]] std::vector<Station> hierarchy_nodes_of(const Partition& partition);
/// The stations, where all leaves below a node form a single station if they have at most `together` faces.
/// In a tree of odd height the root joins two stations, so that stations below join four.
[[nodiscard]] std::vector<Station> hierarchy_nodes_of(const Partition& partition, std::uint64_t together);

[[nodiscard]] std::size_t levels_of(const std::vector<Station>& hierarchy_nodes);

/// [stations] 1 for stations that a simplifying job processes, each with all stations below it. Jobs have
/// similar numbers of faces, and the last run processes the stations above all jobs.
[[nodiscard]] std::vector<std::uint8_t> hierarchy_nodes_of_job(const std::vector<Station>& hierarchy_nodes,
                                                               const CellJob& job);

/// Processes these stations, except the root, each after its children, with as many in parallel as threads
/// and memory allow. wanted: [stations]. bytes_of(station): the memory needed; it is called after the
/// children finish, and may throw.
void settle_below_root(const std::vector<Station>& hierarchy_nodes, const std::vector<std::uint8_t>& wanted,
                       std::uint64_t memory, const std::function<std::uint64_t(std::size_t)>& bytes_of,
                       const std::function<void(std::size_t)>& settle);

/// The work at a station and below it.
struct StationWork {
    double error = 0;
    double area = 0; ///< area of the input mesh
    std::size_t collapses = 0, turned = 0;
};

/// The result of each station, on disk until it is joined.
class LeftCells {
  public:
    /// kept: store results in files of means.kept, if that folder is set.
    LeftCells(const std::vector<Station>& hierarchy_nodes, const CellResources& means, bool kept);

    /// Loads the kept results with this key of these stations and all stations below them. Returns the
    /// stations still to process: [stations] 1, except loaded stations and their descendants. others_go:
    /// removes kept results with other keys.
    std::vector<std::uint8_t> take_up(const std::vector<std::uint8_t>& among, bool others_go);
    /// Thread-safe. Throws an output error (E-WRITE, E-SPACE).
    void put(std::size_t station, Cell cell, const StationWork& work = {});
    const StationWork& work(std::size_t station) const { return left_[station].work; }
    /// The joined children of the station. Thread-safe. Throws an output error (E-SCRATCH).
    Cell joined_at(std::size_t station, const Tree& tree) const;
    std::uint64_t vertices_below(std::size_t station) const; ///< sum over the station's children
    std::uint64_t faces_below(std::size_t station) const;

  private:
    struct Left {
        Block block; ///< position in file_, unless kept
        std::uint64_t vertices = 0, faces = 0;
        StationWork work;
    };
    io::Bytes bytes_of(std::size_t station) const;
    CellFolder::Found take(std::size_t station);

    const std::vector<Station>& hierarchy_nodes_;
    std::shared_ptr<const CellFolder> kept_; ///< null if results are not kept
    std::string key_;
    BlockFile file_;
    std::vector<Left> left_; ///< [stations] results
};

} // namespace facetmill::cells
