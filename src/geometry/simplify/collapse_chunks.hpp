#pragma once
// One pass over one state: edges below a threshold, collapsed in order of cost by workers that never meet.

#include "geometry/simplify/collapse.hpp"

#include <bit>
#include <functional>
#include <span>

namespace facetmill::simplification {

/// Edges by cost; equal ones in an order that is spread over the surface.
struct Candidate {
    std::uint64_t key;
    Index corner;
    Index home; ///< the stretch of both ends, or none
    bool operator<(const Candidate& other) const { return key < other.key; }
};

inline std::uint32_t bits_of(float cost) { return std::bit_cast<std::uint32_t>(cost); }
/// By the cost, then by a bijection of the corner, so that keys stay distinct.
std::uint64_t key_of(float cost, Index corner);

/// Bits of a vertex's number that tell its place within a stretch of the curve.
int stretch_bits(const State& s);

/// What a pass came to; the collapses are joined into the state's log and counts.
struct PassTotals {
    std::size_t collapses = 0;
    double largest = 0;             ///< as Tally
    std::vector<Candidate> later{}; ///< that change the topology and may take more than two faces
};
/// Counts a worker's collapses in the state.
void join(State& s, Tally& tally, PassTotals& totals);

/// Collapses the candidates, none twice at a vertex. found: lists of them, with homes by stretch_bits. most:
/// is asked how many collapses the last worker may make, who is left with what reaches far.
PassTotals collapse_in_chunks(State& s, std::span<const std::vector<Candidate>> found,
                              const std::function<std::size_t()>& most);

/// Whether an edge is still to be collapsed: its face lives, and the pass touched neither end.
inline bool is_open(const State& s, Index corner) {
    return s.live(corner / 3) && s.order.touched[s.tri[corner]] != s.order.pass &&
           s.order.touched[s.tri[after(corner)]] != s.order.pass;
}

void fetch_ends(const State& s, Index corner);
void fetch_lists(const State& s, Index corner);
/// Has the cache bring what the edges after the i-th will be asked for: they lie in no order of memory.
/// state_of: the state of an edge.
template <class Edge, class StateOf>
void fetch_ahead(const std::vector<Edge>& edges, std::size_t i, StateOf&& state_of) {
    if (i + 8 < edges.size()) __builtin_prefetch(&state_of(edges[i + 8]).tri[edges[i + 8].corner]);
    if (i + 5 < edges.size()) fetch_ends(state_of(edges[i + 5]), edges[i + 5].corner);
    if (i + 2 < edges.size()) fetch_lists(state_of(edges[i + 2]), edges[i + 2].corner);
}

} // namespace facetmill::simplification
