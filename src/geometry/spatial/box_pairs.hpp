#pragma once
// Finds all pairs of boxes of a set that meet, in a single walk of a tree against itself.

#include "base/math/simd.hpp"
#include "base/progress.hpp"
#include "geometry/spatial/box_levels.hpp"
#include "mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <span>

namespace facetmill {

/// Built in parallel; the result does not depend on the number of threads. Items with an empty box are in no
/// pair. Float32 boxes are slightly larger than given, so some reported pairs only nearly meet.
class BoxPairs {
  public:
    /// `among`: see `choose`. frame: an additional box that the float32 frame must contain.
    explicit BoxPairs(std::span<const Box> boxes, std::span<const std::uint8_t> among = {},
                      const Box& frame = {});

    /// The box of all boxes so far, including the frame.
    const Box& all() const { return all_; }

    /// From now on reports only pairs with at least one flagged item; empty: all pairs.
    void choose(std::span<const std::uint8_t> among);

    /// Gives the flagged items, or all items if no flags are given, new boxes (boxes of other items are not
    /// read). The order of the items stays, so nothing is sorted. The less the items move, the better the
    /// tree.
    void move_to(std::span<const Box> boxes, std::span<const std::uint8_t> moved);

    /// The items along the curve: neighbours in this order are neighbours in space.
    const std::vector<Index>& items() const { return items_; }

    /// Calls found(T&, i, j) for every pair, where i and j are indices into items(). Each thread collects
    /// its pairs in its own T, and the results are joined from left to right: join(first, second). The
    /// result is the same for any number of threads.
    template <class T, class Found, class Join>
    T reduce(const T& identity, Found&& found, Join&& join) const {
        return reduce_fours(
            identity,
            [&](T& result, std::size_t i, std::size_t four, unsigned bits) {
                for (; bits != 0; bits &= bits - 1) found(result, i, four + lowest(bits));
            },
            std::forward<Join>(join));
    }
    /// Like reduce, up to four pairs at a time: found(T&, i, four, bits) reports the pairs of i with four +
    /// k for every set bit k. `four` is a multiple of 4.
    template <class T, class Found, class Join>
    T reduce_fours(const T& identity, Found&& found, Join&& join) const {
        const std::vector<Couple> tasks = couples_above();
        return parallel_reduce(
            tasks.size(), identity,
            [&](std::size_t begin, std::size_t end) {
                T result = identity;
                for (std::size_t task = begin; task < end; ++task)
                    walk(tasks[task], [&](std::size_t i, std::size_t four, unsigned bits) {
                        found(result, i, four, bits);
                        return true;
                    });
                return result;
            },
            join, tasks_at_once(tasks.size()));
    }

    /// Calls found(i, j) for every pair, in several threads and in no order. Returns the number of pairs. If
    /// it exceeds `most`, returns most + 1, after calling found for only some of the pairs.
    template <class Found>
    std::size_t for_each(std::size_t most, Found&& found) const {
        constexpr std::size_t batch = 1024;
        const std::vector<Couple> tasks = couples_above();
        std::atomic<std::size_t> all = 0;
        ProgressScope::report_next_loop();
        parallel_for(
            tasks.size(),
            [&](std::size_t i) {
                std::size_t mine = 0;
                if (all.load(std::memory_order_relaxed) > most) return;
                walk(tasks[i], [&](std::size_t a, std::size_t four, unsigned bits) {
                    for (; bits != 0; bits &= bits - 1) {
                        found(a, four + lowest(bits));
                        if (++mine % batch == 0 && all.fetch_add(batch) + batch > most) return false;
                    }
                    return true;
                });
                all += mine % batch;
            },
            tasks_at_once(tasks.size()));
        return all <= most ? all.load() : most + 1;
    }

  private:
    using Node = BoxLevels::Node;
    /// Two nodes of a level whose items are to be paired, or the same node twice.
    struct Couple {
        std::int32_t level;
        std::uint32_t a, b;
    };

    /// The number of tasks that a thread takes at once. With few boxes, a single thread takes all tasks,
    /// because starting another thread would take longer.
    std::size_t tasks_at_once(std::size_t tasks) const {
        constexpr std::size_t few = 256;
        return items().size() <= few ? tasks + 1 : 4;
    }

    static std::size_t lowest(unsigned bits) { return static_cast<std::size_t>(std::countr_zero(bits)); }

    /// A bit for each box of the node that meets box s of the other node.
    static unsigned meeting(const Node& node, const Node& other, std::size_t s) {
        Int4 meets = Int4{} - 1;
        for (std::size_t axis = 0; axis < 3; ++axis)
            meets &= (load(node.min[axis]) <= Float4{} + other.max[axis][s]) &
                     (load(node.max[axis]) >= Float4{} + other.min[axis][s]);
        return bits_of(meets);
    }

    /// The pairs of children of two nodes whose boxes meet: found(child of a, first child of b, a bit for
    /// each child of b). If both nodes are the same, each child is also paired with itself, unless the
    /// children are items.
    template <class Found>
    void children(const Couple& c, Found&& found) const {
        const Node &a = levels_.node(c.level, c.a), &b = levels_.node(c.level, c.b);
        for (std::uint32_t s = 0; s < 4; ++s) {
            unsigned bits = meeting(b, a, s);
            if (c.a == c.b) bits &= (c.level > 0 ? 15u : 14u) << s; // each pair once
            if (bits != 0 && !flags_.empty()) bits = wanted(c.level, 4 * c.a + s, 4 * c.b, bits);
            if (bits != 0) found(4 * c.a + s, 4 * c.b, bits);
        }
    }

    /// Keeps only the pairs with a flagged item.
    unsigned wanted(int level, std::uint32_t a, std::uint32_t four, unsigned bits) const {
        const auto& flags = flags_[static_cast<std::size_t>(level)];
        if (flags[a]) return bits;
        for (unsigned left = bits; left != 0; left &= left - 1)
            if (!flags[four + lowest(left)]) bits &= ~(left & -left);
        return bits;
    }

    /// found(i, four, bits) returns whether to continue.
    template <class Found>
    void walk(const Couple& from, Found&& found) const {
        std::array<Couple, 16 * 17> stack; // 17 levels of four hold all indices; fifteen wait at each
        std::size_t size = 0;
        stack[size++] = from;
        bool goes_on = true;
        while (size > 0 && goes_on) {
            const Couple c = stack[--size];
            if (c.level == 0)
                children(c, [&](std::uint32_t s, std::uint32_t four, unsigned bits) {
                    goes_on = goes_on && found(std::size_t{s}, std::size_t{four}, bits);
                });
            else
                children(c, [&](std::uint32_t s, std::uint32_t four, unsigned bits) {
                    for (; bits != 0; bits &= bits - 1)
                        stack[size++] = {c.level - 1, s, four + static_cast<std::uint32_t>(lowest(bits))};
                });
        }
    }

    /// The couples of a level with enough couples to distribute over threads.
    std::vector<Couple> couples_above() const;

    void set(Node& node, std::size_t slot, const Box& box) const;
    void build(std::span<const Box> boxes);

    BoxLevels levels_;
    Box all_; ///< bounds of all boxes so far
    std::vector<Index> items_;
    /// For each level, whether a child of a node has a flagged item. Child i on level 0 is item i.
    std::vector<std::vector<std::uint8_t>> flags_;
};

} // namespace facetmill
