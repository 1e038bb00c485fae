#pragma once
// A tree of boxes over items along a Morton curve, to find the items whose boxes meet a given box.

#include "base/math/vec.hpp"
#include "mesh/mesh.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace facetmill {

/// Whether the boxes have a point in common; touching counts.
inline bool boxes_meet(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

/// The box that contains all given boxes. Parallel.
[[nodiscard]] Box box_of_all(std::span<const Box> boxes);

/// Built once from the items' boxes, in parallel, and then only read. It does not depend on the number of
/// threads. Items with an empty box are never found.
class BoxTree {
  public:
    explicit BoxTree(std::vector<Box> boxes);

    /// Calls found(item) for every item whose box meets or touches `box`. The order depends only on the
    /// boxes.
    template <class Found>
    void visit(const Box& box, Found&& found) const {
        any_of(box, [&](Index item) {
            found(item);
            return false;
        });
    }

    /// Whether holds(item) is true for an item whose box meets or touches `box`. Stops at the first.
    template <class Holds>
    bool any_of(const Box& box, Holds&& holds) const {
        return any_where([&](const Box& other) { return boxes_meet(other, box); }, holds);
    }

    /// The same for the items for whose boxes meets(box) is true. It must also be true for larger boxes.
    template <class Meets, class Holds>
    bool any_where(Meets&& meets, Holds&& holds) const {
        if (levels_.empty()) return false;
        struct Node {
            std::uint32_t level, index;
        };
        Node stack[128]; // two children at each of at most 32 levels
        int size = 0;
        stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
        while (size > 0) {
            const Node node = stack[--size];
            if (!meets(levels_[node.level][node.index])) continue;
            if (node.level == 0) {
                const std::size_t end = std::min(boxes_.size(), std::size_t{node.index + 1} * leaf);
                for (std::size_t i = std::size_t{node.index} * leaf; i < end; ++i)
                    if (meets(boxes_[i]) && holds(items_[i])) return true;
                continue;
            }
            const std::uint32_t child = 2 * node.index;
            if (child + 1 < levels_[node.level - 1].size()) stack[size++] = {node.level - 1, child + 1};
            stack[size++] = {node.level - 1, child};
        }
        return false;
    }

  private:
    static constexpr std::size_t leaf = 4; ///< items in a leaf

    std::vector<Index> items_; ///< items along the curve
    std::vector<Box> boxes_;   ///< boxes of items_
    std::vector<std::vector<Box>>
        levels_; ///< leaves first, the root last; node i is the parent of nodes 2i and 2i + 1
};

} // namespace facetmill
