#pragma once
// A k-d tree by count. Each split puts about half of the faces on either side, until no leaf exceeds a given
// number.

#include "base/math/vec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace facetmill::cells {

/// A tree of nodes in preorder, with the lower child first. The root has number 0.
struct Tree {
    static constexpr std::uint32_t no_node = UINT32_MAX;
    struct Node {
        std::uint32_t child[2] = {no_node, no_node}; ///< the children: both or none
        std::uint32_t parent = no_node;
        std::uint32_t leaf = no_node; ///< the leaf's number in leaf order
        std::uint8_t depth = 0;       ///< 0: the root
        bool is_leaf() const { return child[0] == no_node; }
    };
    std::vector<Node> nodes;
    std::vector<std::uint32_t> leaves; ///< [leaves] their node numbers

    /// Adds the root, or a child of a node. The other child must already exist or come next.
    std::uint32_t add(std::uint32_t parent);
    /// Makes a node the next leaf.
    void make_leaf(std::uint32_t node);
    /// Restores a tree from the result of depths(). False if the depths are invalid; the tree is then
    /// unspecified.
    bool restore(const std::vector<std::uint8_t>& depths);
    /// [leaves] Their depths, which define the tree completely.
    std::vector<std::uint8_t> depths() const;
    /// The depth of the lowest common node of two leaves.
    std::uint8_t common_depth(std::uint32_t leaf, std::uint32_t other) const;
};

/// A grid over a box that counts faces per cell.
class Grid {
  public:
    /// resolution: cells along the longest side, and the maximum along the others.
    explicit Grid(const Box& bounds, std::uint32_t resolution);
    /// The number of the grid cell that contains a position, from 0.
    std::size_t cell_of(const Vec3& p) const;
    std::size_t cells() const { return counts_.size(); }
    /// Counts saturate at 4294967295, because other code divides such cells anyway.
    void count(std::size_t cell, std::uint32_t faces = 1) {
        std::uint32_t& counted = counts_[cell];
        counted += std::min(faces, UINT32_MAX - counted);
    }
    /// Splits the grid at its planes until no leaf has more than `most` faces, except single grid cells.
    /// Replaces the counts by leaf numbers, see leaf_of.
    Tree split(std::uint64_t most);
    std::uint32_t leaf_of(std::size_t cell) const { return counts_[cell]; }

  private:
    using Range = std::array<std::uint32_t, 6>; ///< first and end positions along x, y and z
    std::vector<std::uint64_t> slabs(const Range& r, std::size_t axis) const;
    void split(Tree& tree, std::uint32_t node, const Range& range, std::uint64_t all, std::uint64_t most);
    void label(const Range& range, std::uint32_t leaf);

    Vec3 origin_;
    double per_unit_ = 0;
    std::array<std::uint32_t, 3> size_{};
    std::vector<std::uint32_t> counts_;
};

} // namespace facetmill::cells
