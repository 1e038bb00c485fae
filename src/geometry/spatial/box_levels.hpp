#pragma once
// A tree of float32 boxes over sorted items. Neighbours in the sorted order are neighbours in space. Each
// node has four boxes, so that the processor tests four at a time, and covers four nodes of the level below.
// So the tree needs no pointers, and building it is a sort.

#include "base/math/vec.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace facetmill {

/// Converts to float32, rounding down or up by more than the rounding error of the conversion.
[[nodiscard]] inline float rounded_down(double x) { return static_cast<float>(x - std::abs(x) * 0x1p-22); }
[[nodiscard]] inline float rounded_up(double x) { return static_cast<float>(x + std::abs(x) * 0x1p-22); }

struct BoxLevels {
    /// Four boxes in the tree's own frame (see local), slightly larger than their contents. Empty slots have
    /// min = infinity, max = -infinity.
    struct Node {
        float min[3][4], max[3][4];
        void clear(std::size_t slot);
        /// Sets a box of finite points in the tree's frame, rounded outward.
        void set(std::size_t slot, const Vec3& low, const Vec3& high);
        void set(std::size_t slot, const Node& child);
    };

    int height() const { return static_cast<int>(level_begin.size()); }
    /// Node i of a level. Its child s is item 4i + s on level 0, and node 4i + s of the next lower level
    /// otherwise.
    const Node& node(int level, std::size_t i) const {
        return nodes[level_begin[static_cast<std::size_t>(level)] + i];
    }
    /// The tree's frame has its origin at the middle of the bounds and fits within [-1, 1]. Rounding is
    /// monotonic, so a number between two others stays between them.
    double local(double x, std::size_t axis) const { return (x - middle[axis]) * scale; }
    Vec3 local(const Vec3& p) const { return (p - middle) * scale; }

    /// Sets the frame of a box of finite numbers.
    void set_frame(const Box& all);
    /// Makes the nodes over `items` items: set(node, slot, i) gives item i its box. In parallel.
    template <class Set>
    void build(std::size_t items, Set&& set) {
        number_nodes(items);
        fill(0, items, set);
        for (std::size_t level = 1; level < level_begin.size(); ++level)
            fill(level, count(level - 1), [&](Node& node, std::size_t slot, std::size_t child) {
                node.set(slot, nodes[level_begin[level - 1] + child]);
            });
    }

    Vec3 middle;
    double scale = 1;                     ///< a power of two
    std::vector<std::size_t> level_begin; ///< offsets into nodes; the last level is only the root
    std::vector<Node> nodes;

    /// Recomputes the boxes of the items for which changed(i) holds, and the boxes above them. The frame
    /// does not change.
    template <class Changed, class Set>
    void update(std::size_t items, Changed&& changed, Set&& set) {
        std::vector<std::uint8_t> moved = update_level(0, items, changed, set);
        for (std::size_t level = 1; level < level_begin.size(); ++level)
            moved = update_level(
                level, count(level - 1), [&](std::size_t child) { return moved[child] != 0; },
                [&](Node& node, std::size_t slot, std::size_t child) {
                    node.set(slot, nodes[level_begin[level - 1] + child]);
                });
    }

  private:
    void number_nodes(std::size_t items);
    /// The number of nodes of a level.
    std::size_t count(std::size_t level) const {
        return (level + 1 < level_begin.size() ? level_begin[level + 1] : nodes.size()) - level_begin[level];
    }
    template <class Set>
    void fill(std::size_t level, std::size_t children, Set&& set) {
        Node* const first = nodes.data() + level_begin[level];
        parallel_for(
            count(level),
            [&](std::size_t n) {
                for (std::size_t slot = 0; slot < 4; ++slot)
                    if (4 * n + slot < children)
                        set(first[n], slot, 4 * n + slot);
                    else
                        first[n].clear(slot);
            },
            2048);
    }
    /// Returns [nodes of the level] 1 if a child changed.
    template <class Changed, class Set>
    std::vector<std::uint8_t> update_level(std::size_t level, std::size_t children, Changed&& changed,
                                           Set&& set) {
        Node* const first = nodes.data() + level_begin[level];
        std::vector<std::uint8_t> moved(count(level));
        parallel_for(moved.size(), [&](std::size_t n) {
            for (std::size_t i = 4 * n; i < std::min(4 * n + 4, children); ++i) {
                if (!changed(i)) continue;
                set(first[n], i - 4 * n, i);
                moved[n] = 1;
            }
        });
        return moved;
    }
};

} // namespace facetmill
