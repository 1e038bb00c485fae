#pragma once
// The costs of edges, four at a time.

#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

/// An edge that is to be priced.
struct PricedEdge {
    enum class Held : std::int32_t { no = 0, first = 1, second = 2 }; ///< the end that stays where it is
    Index corner, u, v;
    Held held;
};

/// Sets the costs of edges, and takes their blocks away. Collects them, and prices four whenever they are
/// there; nothing at them may change before `finish`.
class Pricer {
  public:
    explicit Pricer(Work& s) : s_(s), by_fours_(!s.quadrics.empty() && s.fields.channels == 0) {}

    /// The edge of a corner, from u to v, as seen from its face. The cost is kept at one corner of the edge:
    /// the one that runs to the higher vertex, or the only one.
    void operator()(Index corner, Index u, Index v) {
        const std::uint8_t flags = s_.flags[corner] & static_cast<std::uint8_t>(~blocked);
        s_.flags[corner] = flags;
        s_.cost[corner] = never;
        if (!(u < v || (flags & boundary_edge))) return;
        const Kind ku = s_.kind[u], kv = s_.kind[v];
        using Held = PricedEdge::Held;
        if (!may_go(ku, kv, flags))
            s_.flags[corner] |= blocked_border;
        else if (!by_fours_)
            set(corner, cost_of(s_, corner, flags));
        else {
            waiting_[count_++] = {corner, u, v, ku > kv ? Held::first : kv > ku ? Held::second : Held::no};
            if (count_ == 4) finish();
        }
    }

    void finish();

  private:
    void set(Index corner, float cost) {
        if (cost < never)
            s_.cost[corner] = cost; // false for what is no number too
        else
            s_.flags[corner] |= blocked_border;
    }

    Work& s_;
    bool by_fours_;
    std::array<PricedEdge, 4> waiting_;
    std::size_t count_ = 0;
};

/// Sets the costs of all edges.
void price_all(Work& s);

} // namespace facetmill::simplification
