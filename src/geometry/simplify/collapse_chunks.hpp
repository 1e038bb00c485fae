#pragma once
// A pass over a state: workers with disjoint territories collapse the edges below a threshold in order of
// cost.

#include "geometry/simplify/collapse.hpp"

#include <bit>
#include <functional>
#include <span>

namespace facetmill::simplification {

/// An edge sorted by cost. Edges of equal cost are ordered so that they are spread over the surface.
struct Candidate {
    std::uint64_t key;
    Index corner;
    Index home; ///< the chunk that contains both ends, or none
    bool operator<(const Candidate& other) const { return key < other.key; }
};

[[nodiscard]] inline std::uint32_t bits_of(float cost) { return std::bit_cast<std::uint32_t>(cost); }
/// Sorts by cost, then by a bijection of the corner, so that keys are distinct.
[[nodiscard]] std::uint64_t key_of(float cost, Index corner);

/// The number of low bits of a vertex number that give its position within a chunk of the curve.
[[nodiscard]] int stretch_bits(const State& s);

/// The totals of a pass; the collapses are also added to the state's log and counts.
struct PassTotals {
    std::size_t collapses = 0;
    double largest = 0; ///< see Tally
    std::vector<Candidate>
        later{}; ///< edges whose collapse changes the topology and may remove more than two faces
};
/// Adds a worker's collapses to the state.
void join(State& s, Tally& tally, PassTotals& totals);

/// Collapses the candidates, at most once per vertex. found: lists of candidates, with homes by stretch_bits.
/// most: returns how many collapses the last worker may make; that worker handles the edges with distant
/// surroundings.
[[nodiscard]] PassTotals collapse_in_chunks(State& s, std::span<const std::vector<Candidate>> found,
                                            const std::function<std::size_t()>& most);

/// True if an edge may still be collapsed: its face is alive, and the pass touched neither end.
inline bool is_open(const State& s, Index corner) {
    return s.live(corner / 3) && s.order.touched[s.tri[corner]] != s.order.pass &&
           s.order.touched[s.tri[after(corner)]] != s.order.pass;
}

void fetch_ends(const State& s, Index corner);
void fetch_lists(const State& s, Index corner);
/// Prefetches the data of the edges after the i-th, because edges in order of cost are scattered in memory.
/// state_of: returns the state of an edge.
template <class Edge, class StateOf>
void fetch_ahead(const std::vector<Edge>& edges, std::size_t i, StateOf&& state_of) {
    if (i + 8 < edges.size()) __builtin_prefetch(&state_of(edges[i + 8]).tri[edges[i + 8].corner]);
    if (i + 5 < edges.size()) fetch_ends(state_of(edges[i + 5]), edges[i + 5].corner);
    if (i + 2 < edges.size()) fetch_lists(state_of(edges[i + 2]), edges[i + 2].corner);
}

} // namespace facetmill::simplification
