#pragma once
// A k-d tree by count: space is halved so that about as many faces are on either side, until no leaf has more
// than a given number.

#include "base/math/vec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace facetmill::cells {

/// Nodes in the order of a walk that goes into a node before its children, the lower first; the root is
/// number 0.
struct Tree {
    static constexpr std::uint32_t no_node = UINT32_MAX;
    struct Node {
        std::uint32_t child[2] = {no_node, no_node}; ///< both or none
        std::uint32_t parent = no_node;
        std::uint32_t leaf = no_node; ///< its number among the leaves, in their order
        std::uint8_t depth = 0;       ///< 0: the root
        bool is_leaf() const { return child[0] == no_node; }
    };
    std::vector<Node> nodes;
    std::vector<std::uint32_t> leaves; ///< [leaves] their nodes

    /// Adds a root, or a child of a node whose other child is there, or comes next.
    std::uint32_t add(std::uint32_t parent);
    /// Makes a node a leaf: the next one.
    void make_leaf(std::uint32_t node);
    /// What depths() gave. False where no tree has such leaves; nothing is promised of it then.
    bool restore(const std::vector<std::uint8_t>& depths);
    /// [leaves] How deep they are, which is all that a tree is made of.
    std::vector<std::uint8_t> depths() const;
    /// How deep the node is that two leaves have in common.
    std::uint8_t common_depth(std::uint32_t leaf, std::uint32_t other) const;
};

/// A grid over a box, whose cells count what falls into them.
class Grid {
  public:
    /// resolution: cells along the longest side, also the most along any other.
    explicit Grid(const Box& bounds, std::uint32_t resolution);
    /// The number of the cell of the grid that a place is in, from 0.
    std::size_t cell_of(const Vec3& p) const;
    std::size_t cells() const { return counts_.size(); }
    /// More than 4294967295 in a cell count as so many: it is divided by other means all the same.
    void count(std::size_t cell, std::uint32_t faces = 1) {
        std::uint32_t& counted = counts_[cell];
        counted += std::min(faces, UINT32_MAX - counted);
    }
    /// Splits the grid at its planes: no leaf has more than `most`, but where a single cell of the grid has.
    /// The counts are then those leaves' numbers, see leaf_of.
    Tree split(std::uint64_t most);
    std::uint32_t leaf_of(std::size_t cell) const { return counts_[cell]; }

  private:
    using Range = std::array<std::uint32_t, 6>; ///< first and end along x, y, z
    std::vector<std::uint64_t> slabs(const Range& r, std::size_t axis) const;
    void split(Tree& tree, std::uint32_t node, const Range& range, std::uint64_t all, std::uint64_t most);
    void label(const Range& range, std::uint32_t leaf);

    Vec3 origin_;
    double per_unit_ = 0;
    std::array<std::uint32_t, 3> size_{};
    std::vector<std::uint32_t> counts_;
};

} // namespace facetmill::cells
