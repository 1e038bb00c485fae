#pragma once
// What a collapse costs and where its vertex goes: Garland and Heckbert's quadrics, or the length of the
// edge.

#include "geometry/simplify/state.hpp"

namespace facetmill::simplification {

/// A face whose height is below this share of its longest edge counts as flat: far above what rounding can
/// do, far below what anyone wants.
inline constexpr double least_height = 1e-5;

/// Squared errors below this share of an edge's squared length are too small for single precision, by a
/// factor of ten or more.
inline constexpr double doubtful = 4e-6;

/// Of every vertex, from the faces' planes and from the planes that hold feature edges and sharp folds.
std::vector<NearQuadric> vertex_quadrics(const State& s);
/// The quadrics and, where much of the surface is flat or nearly so, the fine ones.
void set_quadrics(State& s);

/// Whether an edge between vertices of these kinds may be collapsed.
inline bool may_go(Kind u, Kind v, std::uint8_t flags) {
    if (u >= Kind::corner && v >= Kind::corner) return false;
    return u == Kind::smooth || v == Kind::smooth || (flags & feature_edge); // not across a feature
}

/// What to do with an edge that may go.
struct Placement {
    Vec3 at;
    double error = 0; ///< squared distance, as far as the quadric or the edge's length tells
    bool keep_first = false, keep_second = false; ///< the new vertex is this end as it is
    Quadric joined{};                             ///< of the planes of both ends, about `at`
};
/// Where the ends of the edge of a corner should meet. flags: the corner's.
Placement place(const State& s, Index corner, std::uint8_t flags);
/// What it costs to collapse the edge of a corner that may go.
float cost_of(const State& s, Index corner, std::uint8_t flags);

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
    explicit Pricer(State& s) : s_(s), by_fours_(s.quadrics && !s.quadrics->attributes) {}

    /// The edge of a corner, from u to v, as seen from its face. The cost is kept at one corner of the edge:
    /// the one that runs to the higher vertex, or the only one.
    void operator()(Index corner, Index u, Index v) {
        const std::uint8_t flags = s_.edges.flags[corner] & static_cast<std::uint8_t>(~blocked);
        s_.edges.flags[corner] = flags;
        s_.edges.cost[corner] = never;
        if (!(u < v || (flags & boundary_edge))) return;
        const Kind ku = s_.features->kind[u], kv = s_.features->kind[v];
        using Held = PricedEdge::Held;
        if (!may_go(ku, kv, flags))
            s_.edges.flags[corner] |= blocked_border;
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
            s_.edges.cost[corner] = cost; // false for what is no number too
        else
            s_.edges.flags[corner] |= blocked_border;
    }

    State& s_;
    bool by_fours_;
    std::array<PricedEdge, 4> waiting_;
    std::size_t count_ = 0;
};

/// Sets the costs of all edges.
void price_all(State& s);

} // namespace facetmill::simplification
