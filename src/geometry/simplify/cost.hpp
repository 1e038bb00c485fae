#pragma once
// The cost of a collapse and the position of its vertex: Garland and Heckbert's quadrics, or the length of
// the edge.

#include "geometry/simplify/state.hpp"

namespace facetmill::simplification {

/// A face whose height is below this share of its longest edge counts as flat. The limit is far above
/// rounding errors and far below any useful height.
inline constexpr double least_height = 1e-5;

/// Squared errors below this share of an edge's squared length are too small for single precision, by a
/// factor of ten or more.
inline constexpr double doubtful = 4e-6;

/// The quadrics of all vertices. Each sums the planes of its faces, and the planes that hold feature edges
/// and sharp folds.
[[nodiscard]] std::vector<NearQuadric> vertex_quadrics(const State& s);
/// Sets the quadrics; also the fine quadrics if much of the surface is flat or nearly flat.
void set_quadrics(State& s);

/// True if an edge between vertices of these kinds may be collapsed.
inline bool may_go(Kind u, Kind v, std::uint8_t flags) {
    if (u >= Kind::corner && v >= Kind::corner) return false;
    return u == Kind::smooth || v == Kind::smooth || (flags & feature_edge); // not across a feature
}

/// The position of the vertex of a collapse, for an edge that may_go allows.
struct Placement {
    Vec3 at;
    double error = 0; ///< squared distance, as estimated by the quadric or the edge's length
    bool keep_first = false, keep_second = false; ///< the new vertex is exactly this end
    Quadric joined{};                             ///< sum of the quadrics of both ends, relative to `at`
};
/// Finds the point where the ends of a corner's edge should meet. flags: the corner's.
[[nodiscard]] Placement place(const State& s, Index corner, std::uint8_t flags);
/// The cost of collapsing a corner's edge. The edge must be allowed by may_go.
[[nodiscard]] float cost_of(const State& s, Index corner, std::uint8_t flags);

/// An edge whose cost is to be computed.
struct PricedEdge {
    enum class Held : std::int32_t { no = 0, first = 1, second = 2 }; ///< the end that keeps its position
    Index corner, u, v;
    Held held;
};

/// Sets the costs of edges, and clears their blocked flags. It collects edges and computes the costs of four
/// at a time. Nothing at these edges may change before `finish`.
class Pricer {
  public:
    explicit Pricer(State& s) : s_(s), by_fours_(s.quadrics && !s.quadrics->attributes) {}

    /// Adds the edge of a corner, from u to v in the direction of its face. The cost is stored at one corner
    /// of the edge: the corner that runs to the higher vertex, or the only corner.
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
            s_.edges.cost[corner] = cost; // false for NaN too
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
