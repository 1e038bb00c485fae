// The vertices are cut into chunks of the Morton curve, and the edges are collapsed in three rounds. First,
// one worker per chunk handles the edges whose surroundings lie within the chunk. Then one worker per pair of
// chunks handles the edges that reach into one other chunk; concurrent pairs have no chunk in common. Finally
// one worker handles the few other edges. No two workers ever touch the same vertex or face, and the result
// does not depend on the number of workers. A worker reads the surroundings of vertices in its own chunks
// only, and changes nothing unless they are complete. If an edge of the surroundings connects two chunks,
// only the worker of both chunks changes its ends and their faces.

#include "geometry/simplify/collapse_chunks.hpp"

#include "parallel/parallel.hpp"

#include <memory>

namespace facetmill::simplification {

namespace {

constexpr int stretches_bits = 4;                   // small surfaces have 8 to 16 chunks
constexpr int least_stretch = 11, max_stretch = 13; // sizes in bits: 2048 to 8192 vertices

/// A bijection of 32 bits.
std::uint32_t scattered(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// A candidate that reaches into two chunks.
struct Crossing {
    Index low, high; ///< the chunks
    Candidate edge;
    bool operator<(const Crossing& o) const {
        return low != o.low ? low < o.low : high != o.high ? high < o.high : edge < o.edge;
    }
};

/// The edges of one worker, and the results.
struct Share {
    Territory territory;
    std::vector<Candidate> edges{};
    std::vector<Crossing>
        crossing{};                 ///< edges that reach from the territory's only chunk into one other chunk
    std::vector<Candidate> rest{};  ///< edges that reach into more chunks
    std::vector<Candidate> later{}; ///< edges whose collapse changes the topology
    Tally tally{};
};

/// Classifies an edge that reaches beyond the share's territory, by the part of its surroundings that is
/// known.
void hand_on(Share& share, const Candidate& edge, const Around& around) {
    const Territory& mine = share.territory;
    const auto stretch = [&](Index v) { return v / mine.size; };
    const Index home = stretch(mine.first);
    Index other = home;
    bool farther = mine.second != mine.first;
    for (const Ring* ring : {&around.at_a, &around.at_b})
        for (const RingCorner& corner : *ring)
            for (const Index v : {corner.next, corner.before}) {
                if (stretch(v) == home || stretch(v) == other) continue;
                farther |= other != home;
                other = stretch(v);
            }
    if (farther)
        share.rest.push_back(edge);
    else
        share.crossing.push_back({std::min(home, other), std::max(home, other), edge});
}

/// Collapses the edges of a share in order of cost: at most `most`, and at most once per vertex in a pass.
void collapse_share(State& s, Share& share, std::size_t most) {
    if (share.edges.empty()) return;
    std::sort(share.edges.begin(), share.edges.end());
    const auto around = std::make_unique_for_overwrite<Around>();
    around->territory = share.territory;
    around->waits = true;
    Pricer pricer(s);
    for (std::size_t i = 0; i < share.edges.size(); ++i) {
        fetch_ahead(share.edges, i, [&](const Candidate&) -> const State& { return s; });
        const Candidate& k = share.edges[i];
        if (!is_open(s, k.corner)) continue;
        const Attempt attempt = collapse(s, k.corner, *around, pricer, share.tally);
        if (attempt == Attempt::outside) hand_on(share, k, *around);
        if (attempt == Attempt::later) share.later.push_back(k);
        // A collapse normally removes two faces and one vertex. At a boundary it removes one face, so another
        // pass may be needed.
        if (share.tally.collapses >= most) break;
    }
}

class Stretches {
  public:
    Stretches(State& s, std::span<const std::vector<Candidate>> found) : s_(s), bits_(stretch_bits(s)) {
        shares_.resize(stretch(static_cast<Index>(s_.vertex_slots() - 1)) + 1);
        for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i].territory = territory(i, i);
        for (const auto& list : found)
            for (const Candidate& k : list)
                if (k.home != none)
                    shares_[k.home].edges.push_back(k);
                else
                    crossing_.push_back(crossing(k));
    }

    /// Handles each chunk, then pairs of chunks, then the rest.
    PassTotals run(const std::function<std::size_t()>& most) {
        work_all(shares_);
        std::sort(crossing_.begin(), crossing_.end());
        for (auto& pairs : in_turns()) work_all(pairs);
        collapse_share(s_, rest_, most());
        take(rest_);
        return std::move(totals_);
    }

  private:
    Index stretch(Index v) const { return v >> bits_; }

    Territory territory(std::size_t x, std::size_t y) const {
        const auto lowest = [&](std::size_t i) { return static_cast<Index>(i << bits_); };
        return {lowest(1), lowest(x), lowest(y)};
    }

    Crossing crossing(const Candidate& k) const {
        const Index x = stretch(s_.tri[k.corner]), y = stretch(s_.tri[after(k.corner)]);
        return {std::min(x, y), std::max(x, y), k};
    }

    void work_all(std::vector<Share>& shares) {
        parallel_for(
            shares.size(), [&](std::size_t i) { collapse_share(s_, shares[i], s_.rings.live_faces); }, 1);
        for (Share& share : shares) {
            take(share);
            crossing_.insert(crossing_.end(), share.crossing.begin(), share.crossing.end());
            rest_.edges.insert(rest_.edges.end(), share.rest.begin(), share.rest.end());
        }
    }

    void take(Share& share) {
        join(s_, share.tally, totals_);
        totals_.later.insert(totals_.later.end(), share.later.begin(), share.later.end());
    }

    /// Groups the crossing edges by pairs of chunks, and the pairs into turns in which no chunk occurs twice.
    std::vector<std::vector<Share>> in_turns() {
        std::vector<std::vector<Share>> turns;
        std::vector<std::uint64_t> busy(shares_.size()); // bit mask of the turns that use the chunk
        for (std::size_t i = 0; i < crossing_.size();) {
            const auto [low, high, _] = crossing_[i];
            const auto turn = static_cast<std::size_t>(std::countr_one(busy[low] | busy[high]));
            std::size_t end = i;
            while (end < crossing_.size() && crossing_[end].low == low && crossing_[end].high == high) ++end;
            if (turn < 64 && turn >= turns.size()) turns.emplace_back();
            auto& to = turn < 64 ? turns[turn].emplace_back(Share{territory(low, high)}) : rest_;
            for (; i < end; ++i) to.edges.push_back(crossing_[i].edge);
            if (turn >= 64) continue;
            busy[low] |= std::uint64_t{1} << turn;
            busy[high] |= std::uint64_t{1} << turn;
        }
        return turns;
    }

    State& s_;
    int bits_;
    std::vector<Share> shares_;      // a share per chunk
    std::vector<Crossing> crossing_; // edges between two chunks
    Share rest_;
    PassTotals totals_;
};

void join_logs(Collapses& all, const Collapses& more) {
    const auto before = static_cast<Index>(all.wedges.size());
    for (Step step : more.steps) {
        step.wedges += before;
        all.steps.push_back(step);
    }
    all.wedges.insert(all.wedges.end(), more.wedges.begin(), more.wedges.end());
}

} // namespace

std::uint64_t key_of(float cost, Index corner) {
    return (std::uint64_t{bits_of(cost)} << 32) | scattered(corner);
}

int stretch_bits(const State& s) {
    const int bits = static_cast<int>(std::bit_width(s.vertex_slots() - 1));
    return std::clamp(bits - stretches_bits, least_stretch, max_stretch);
}

void fetch_ends(const State& s, Index corner) {
    for (const Index v : {s.tri[corner], s.tri[after(corner)]}) {
        if (v == none) continue;
        __builtin_prefetch(&s.rings.first[v]);
        __builtin_prefetch(&s.order.touched[v]);
        __builtin_prefetch(&s.at[v]);
    }
}

void fetch_lists(const State& s, Index corner) {
    for (const Index v : {s.tri[corner], s.tri[after(corner)]}) {
        if (v == none || s.order.touched[v] == s.order.pass || s.rings.first[v] == none) continue;
        __builtin_prefetch(&s.tri[s.rings.first[v]]);
        __builtin_prefetch(&s.rings.next[s.rings.first[v]]);
        if (s.quadrics) __builtin_prefetch(&s.quadrics->near[v]);
    }
}

void join(State& s, Tally& tally, PassTotals& totals) {
    s.rings.live_faces -= tally.faces;
    s.rings.live_vertices -= tally.vertices;
    totals.collapses += tally.collapses;
    totals.largest = std::max(totals.largest, tally.largest);
    if (s.log) join_logs(*s.log, tally.log);
}

PassTotals collapse_in_chunks(State& s, std::span<const std::vector<Candidate>> found,
                              const std::function<std::size_t()>& most) {
    return Stretches(s, found).run(most);
}

} // namespace facetmill::simplification
