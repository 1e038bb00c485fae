#pragma once
// Finds the pieces of faces at an edge. Only crop uses it.

#include "mesh/mesh.hpp"

#include <bit>
#include <utility>

namespace facetmill {

/// The pieces that were added for each edge. Some may have been replaced since.
class PiecesAtEdges {
  public:
    PiecesAtEdges() : last_(64, none) {}

    void add(Index u, Index v, Index piece) {
        if (items_.size() == last_.size()) grow();
        Index& last = last_[place(u, v)];
        items_.push_back({std::min(u, v), std::max(u, v), piece, last});
        last = static_cast<Index>(items_.size() - 1);
    }
    /// Calls visit(piece) for the pieces of the edge, the last first.
    template <class Visit>
    void visit(Index u, Index v, Visit&& visit) const {
        if (u > v) std::swap(u, v);
        for (Index i = last_[place(u, v)]; i != none; i = items_[i].next)
            if (items_[i].low == u && items_[i].high == v) visit(items_[i].piece);
    }

  private:
    struct Item {
        Index low, high, piece, next;
    };
    /// A multiplicative hash with odd numbers near 2^64 divided by the golden ratio; the upper bits are mixed
    /// best.
    std::size_t place(Index u, Index v) const {
        const std::uint64_t key = std::uint64_t{std::min(u, v)} << 32 | std::max(u, v);
        return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u ^ key >> 32) * 0x9E3779B97F4A7C15u >>
                                        (64 - std::countr_zero(last_.size())));
    }
    void grow() {
        last_.assign(2 * last_.size(), none);
        for (Index i = 0; i < items_.size(); ++i) {
            Index& last = last_[place(items_[i].low, items_[i].high)];
            items_[i].next = std::exchange(last, i);
        }
    }

    std::vector<Index> last_; ///< [a power of two] the last item of each hash, as an index into items_
    std::vector<Item> items_;
};

} // namespace facetmill
