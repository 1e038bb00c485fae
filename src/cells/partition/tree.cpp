#include "cells/partition/tree.hpp"
#include "base/math/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace facetmill::cells {

std::uint32_t Tree::add(std::uint32_t parent) {
    const auto number = static_cast<std::uint32_t>(nodes.size());
    Node node;
    node.parent = parent;
    if (parent != no_node) {
        node.depth = static_cast<std::uint8_t>(nodes[parent].depth + 1);
        nodes[parent].child[nodes[parent].child[0] == no_node ? 0 : 1] = number;
    }
    nodes.push_back(node);
    return number;
}

void Tree::make_leaf(std::uint32_t node) {
    nodes[node].leaf = static_cast<std::uint32_t>(leaves.size());
    leaves.push_back(node);
}

bool Tree::restore(const std::vector<std::uint8_t>& depths) {
    *this = {};
    std::vector<std::uint32_t> waiting{no_node}; // parents of future nodes; the next is last
    for (const std::uint8_t depth : depths) {
        if (waiting.empty()) return false;
        std::uint32_t node = add(waiting.back());
        waiting.pop_back();
        if (nodes[node].depth > depth) return false;
        while (nodes[node].depth < depth) {
            waiting.push_back(node);
            node = add(node);
        }
        make_leaf(node);
    }
    return waiting.empty();
}

std::vector<std::uint8_t> Tree::depths() const {
    std::vector<std::uint8_t> depths;
    for (const std::uint32_t leaf : leaves) depths.push_back(nodes[leaf].depth);
    return depths;
}

std::uint8_t Tree::common_depth(std::uint32_t leaf, std::uint32_t other) const {
    std::uint32_t a = leaves[leaf], b = leaves[other];
    while (a != b) {
        std::uint32_t& deeper = nodes[a].depth >= nodes[b].depth ? a : b;
        deeper = nodes[deeper].parent;
    }
    return nodes[a].depth;
}

Grid::Grid(const Box& bounds, std::uint32_t resolution) : origin_(bounds.min) {
    const Vec3 extent = bounds.extent();
    const double longest = bounds.longest_side();
    if (longest > 0 && std::isfinite(longest)) per_unit_ = resolution / longest;
    if (!std::isfinite(per_unit_)) per_unit_ = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        size_[axis] = std::clamp<std::uint32_t>(
            whole_number<std::uint32_t>(std::ceil(extent[axis] * per_unit_)), 1, resolution);
    counts_.assign(std::size_t{size_[0]} * size_[1] * size_[2], 0);
}

std::size_t Grid::cell_of(const Vec3& p) const {
    std::array<std::size_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = (p[axis] - origin_[axis]) * per_unit_; // clamps NaN and values outside
        at[axis] = x >= size_[axis] - 1 ? size_[axis] - 1 : x > 0 ? static_cast<std::size_t>(x) : 0;
    }
    return (at[2] * size_[1] + at[1]) * size_[0] + at[0];
}

Tree Grid::split(std::uint64_t most) {
    Tree tree;
    const Range whole{0, size_[0], 0, size_[1], 0, size_[2]};
    const std::uint64_t all = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
    split(tree, tree.add(Tree::no_node), whole, all, most);
    return tree;
}

/// The sums of the range's counts for each position along an axis.
std::vector<std::uint64_t> Grid::slabs(const Range& r, std::size_t axis) const {
    std::vector<std::uint64_t> sums(r[2 * axis + 1] - r[2 * axis]);
    for (std::uint32_t z = r[4]; z < r[5]; ++z)
        for (std::uint32_t y = r[2]; y < r[3]; ++y) {
            const std::uint32_t* row = &counts_[(std::size_t{z} * size_[1] + y) * size_[0]];
            for (std::uint32_t x = r[0]; x < r[1]; ++x)
                sums[(axis == 0 ? x : axis == 1 ? y : z) - r[2 * axis]] += row[x];
        }
    return sums;
}

void Grid::label(const Range& r, std::uint32_t leaf) {
    for (std::uint32_t z = r[4]; z < r[5]; ++z)
        for (std::uint32_t y = r[2]; y < r[3]; ++y) {
            std::uint32_t* row = &counts_[(std::size_t{z} * size_[1] + y) * size_[0]];
            std::fill(row + r[0], row + r[1], leaf);
        }
}

void Grid::split(Tree& tree, std::uint32_t node, const Range& range, std::uint64_t all, std::uint64_t most) {
    constexpr std::uint8_t deepest = 200; // depths are bytes
    struct Cut {
        std::size_t axis;
        std::uint32_t plane;
        std::uint64_t below;
    };
    std::optional<Cut> best;
    std::uint32_t best_extent = 0;
    for (std::size_t axis = 0; axis < 3 && all > most && tree.nodes[node].depth < deepest; ++axis) {
        const auto sums = slabs(range, axis);
        const auto used = [](std::uint64_t n) { return n > 0; };
        const auto first = std::find_if(sums.begin(), sums.end(), used) - sums.begin();
        const auto last = sums.rend() - std::find_if(sums.rbegin(), sums.rend(), used);
        if (last - first < 2 || static_cast<std::uint32_t>(last - first) <= best_extent) continue;
        best_extent = static_cast<std::uint32_t>(last - first);
        Cut cut{axis, 0, 0};
        std::uint64_t below = 0, nearest = UINT64_MAX;
        for (auto i = first; i + 1 < last; ++i) {
            below += sums[static_cast<std::size_t>(i)];
            const std::uint64_t off = below > all - below ? below - (all - below) : all - below - below;
            if (off < nearest) {
                nearest = off;
                cut.plane = range[2 * axis] + static_cast<std::uint32_t>(i) + 1;
                cut.below = below;
            }
        }
        best = cut;
    }
    if (!best) {
        tree.make_leaf(node);
        return label(range, tree.nodes[node].leaf);
    }
    Range low = range, high = range;
    low[2 * best->axis + 1] = high[2 * best->axis] = best->plane;
    split(tree, tree.add(node), low, best->below, most);
    split(tree, tree.add(node), high, all - best->below, most);
}

} // namespace facetmill::cells
