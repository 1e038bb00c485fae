// The order of collapses. One pass: a global threshold on the costs of all edges, and the edges below it
// collapsed in order of cost, none twice at a vertex, each followed by the costs of the edges that changed.
// Costs depend on an edge's two ends only, and an untouched end keeps its quadric, so every cost is exact
// when its edge collapses.
//
// The vertices are cut into stretches of the Morton curve. Edges whose surroundings lie within one stretch
// are collapsed by one worker per stretch; then those that reach into one other, by one worker per pair of
// stretches, pairs without a stretch in common at a time; then the few others by one worker. No two workers
// ever touch the same vertex or face, and the result does not depend on how many there are: a worker asks
// about the surroundings of vertices of its stretches only, and changes nothing unless all of them are there.
// Where an edge of the surroundings leads from one stretch to another, only the worker of both ever changes
// its ends and their faces.

#include "geometry/simplify/methods.hpp"

#include "base/parallel.hpp"

#include <bit>
#include <memory>
#include <numeric>

namespace facetmill::simplification {

namespace {

constexpr std::size_t face_chunk = 1 << 13;
constexpr int stretches_bits = 4;                   // of a small surface: 8 to 16 stretches
constexpr int least_stretch = 11, max_stretch = 13; // bits: 2048 to 8192 vertices
constexpr double share_per_pass = 1.0 / 8;          // of the live edges that are candidates in one pass
constexpr int bucket_shift = 19;                    // of a cost's bits: 16 buckets per power of two
// Buckets: near the goal, no edge goes before one of a quarter of its cost.
constexpr std::size_t last_span = 32;
// As their surroundings were.
constexpr std::uint8_t refused = blocked_topology | blocked_flip | blocked_error;
constexpr std::size_t buckets = 0x7f800000u >> bucket_shift;

std::uint32_t bits_of(float cost) { return std::bit_cast<std::uint32_t>(cost); }
/// A bijection of 32 bits, so that keys stay distinct.
std::uint32_t scattered(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
std::uint64_t key_of(float cost, Index c) { return (std::uint64_t{bits_of(cost)} << 32) | scattered(c); }

/// Edges by cost; equal ones in an order that is spread over the surface.
struct Candidate {
    std::uint64_t key;
    Index corner;
    Index home; ///< the stretch of both ends, or none
    bool operator<(const Candidate& other) const { return key < other.key; }
};

/// A candidate that reaches into two stretches.
struct Crossing {
    Index low, high; ///< the stretches
    Candidate edge;
    bool operator<(const Crossing& o) const {
        return low != o.low ? low < o.low : high != o.high ? high < o.high : edge < o.edge;
    }
};

/// The edges that one worker looks at, and what came of it.
struct Share {
    Territory territory;
    std::vector<Candidate> edges{};
    std::vector<Crossing> crossing{}; ///< reach from the only stretch of the territory into one other
    std::vector<Candidate> rest{};    ///< reach farther
    Tally tally{};
};

void fetch_ends(const State& s, Index corner) {
    for (const Index v : {s.tri[corner], s.tri[after(corner)]}) {
        if (v == none) continue;
        __builtin_prefetch(&s.first[v]);
        __builtin_prefetch(&s.touched[v]);
        __builtin_prefetch(&s.at[v]);
    }
}

void fetch_lists(const State& s, Index corner) {
    for (const Index v : {s.tri[corner], s.tri[after(corner)]}) {
        if (v == none || s.touched[v] == s.pass || s.first[v] == none) continue;
        __builtin_prefetch(&s.tri[s.first[v]]);
        __builtin_prefetch(&s.next[s.first[v]]);
        if (s.quadrics) __builtin_prefetch(&(*s.quadrics)[v]);
    }
}

/// Has the cache bring what the next candidates will be asked for: they lie in no order of memory.
void fetch_ahead(const State& s, const std::vector<Candidate>& edges, std::size_t i) {
    if (i + 8 < edges.size()) __builtin_prefetch(&s.tri[edges[i + 8].corner]);
    if (i + 5 < edges.size()) fetch_ends(s, edges[i + 5].corner);
    if (i + 2 < edges.size()) fetch_lists(s, edges[i + 2].corner);
}

/// Notes an edge that reaches beyond the territory of the share, as far as the surroundings say.
void hand_on(Share& share, const Candidate& edge, const Around& around) {
    const Territory& mine = share.territory;
    const auto stretch = [&](Index v) { return v / mine.size; };
    const Index home = stretch(mine.first);
    Index other = home;
    bool farther = mine.second != mine.first;
    for (const Ring* ring : {&around.at_a, &around.at_b})
        for (const Spoke& spoke : *ring)
            for (const Index v : {spoke.next, spoke.before}) {
                if (stretch(v) == home || stretch(v) == other) continue;
                farther |= other != home;
                other = stretch(v);
            }
    if (farther)
        share.rest.push_back(edge);
    else
        share.crossing.push_back({std::min(home, other), std::max(home, other), edge});
}

/// Collapses the edges of a share in order of cost, at most so many, none at a vertex that the pass touched.
void collapse_share(State& s, Share& share, std::size_t most) {
    std::sort(share.edges.begin(), share.edges.end());
    const auto around = std::make_unique<Around>();
    around->territory = share.territory;
    Pricer pricer(s);
    for (std::size_t i = 0; i < share.edges.size(); ++i) {
        fetch_ahead(s, share.edges, i);
        const Candidate& k = share.edges[i];
        if (!s.live(k.corner / 3)) continue;
        const Index u = s.tri[k.corner], v = s.tri[after(k.corner)];
        if (s.touched[u] == s.pass || s.touched[v] == s.pass) continue;
        if (collapse(s, k.corner, *around, pricer, share.tally) == Attempt::outside)
            hand_on(share, k, *around);
        // Two faces and one vertex a time; at a boundary one face, so the last step may need looking at
        // again.
        if (share.tally.collapses >= most) break;
    }
}

class Passes {
  public:
    Passes(State& s, const Goal& goal) : s_(s), goal_(goal) {}

    Outcome run() {
        refresh_all_ = true;
        while (!goal_.met(s_)) {
            ++out_.passes;
            ++s_.pass;
            if (std::exchange(refresh_all_, false))
                price_all(s_);
            else
                price_dirty();
            const std::uint32_t limit = threshold();
            if (limit == 0) {
                out_.stuck = !try_again();
                if (out_.stuck) break;
                continue;
            }
            gather(limit);
            commit();
            if (10 * s_.live_faces < 6 * s_.face_slots()) compact(s_);
        }
        return out_;
    }

  private:
    /// Collapses to go, if each takes two faces and one vertex.
    std::size_t remaining() const {
        return std::min((s_.live_faces - goal_.faces + 1) / 2, s_.live_vertices - goal_.vertices);
    }
    /// So near the goal that one worker finishes, in strict order.
    bool last_steps() const { return remaining() <= std::max<std::size_t>(256, s_.live_faces / 64); }
    Index stretch(Index v) const { return v >> stretch_bits_; }

    /// Edges that were refused and have a neighbour that changed in the last pass are asked again.
    void price_dirty() {
        parallel_chunks(
            s_.flags.size(),
            [&](std::size_t begin, std::size_t end) {
                Pricer pricer(s_);
                for (auto c = static_cast<Index>(begin); c < end; ++c) {
                    if (!(s_.flags[c] & refused) || !s_.live(c / 3)) continue;
                    const Index u = s_.tri[c], v = s_.tri[after(c)];
                    if (s_.dirty[u] == s_.pass - 1 || s_.dirty[v] == s_.pass - 1) pricer(c, u, v);
                }
                pricer.finish();
            },
            3 * face_chunk);
    }

    /// Bits of a cost: edges below are candidates. 0 when no edge is left.
    std::uint32_t threshold() {
        const std::vector<Index> all = histogram();
        const std::size_t live = std::accumulate(all.begin(), all.end(), std::size_t{0});
        if (live == 0) return 0;
        const auto share = static_cast<std::size_t>(static_cast<double>(live) * share_per_pass);
        const std::size_t wanted =
            last_steps() ? 4 * remaining() + 64 : std::clamp<std::size_t>(share, 64, remaining());
        std::size_t below = 0, i = 0, cheapest = buckets;
        for (; i < buckets; ++i) {
            if (below > 0 && (below + all[i] > wanted || (last_steps() && i > cheapest + last_span))) break;
            if (below == 0 && all[i] > 0) cheapest = i;
            below += all[i];
        }
        return static_cast<std::uint32_t>(i) << bucket_shift;
    }

    /// How many edges have which cost.
    std::vector<Index> histogram() const {
        using Counts = std::vector<Index>;
        return parallel_reduce(
            s_.cost.size(), Counts(buckets),
            [&](std::size_t begin, std::size_t end) {
                Counts counts(buckets + 1); // the last for what is never
                for (std::size_t c = begin; c < end; ++c) ++counts[bits_of(s_.cost[c]) >> bucket_shift];
                counts.pop_back();
                return counts;
            },
            [](Counts a, const Counts& b) {
                for (std::size_t i = 0; i < buckets; ++i) a[i] += b[i];
                return a;
            },
            3 * face_chunk);
    }

    /// Finds the edges below the threshold.
    std::vector<std::vector<Candidate>> candidates(std::uint32_t limit) const {
        std::vector<std::vector<Candidate>> found((s_.face_slots() + face_chunk - 1) / face_chunk);
        parallel_chunks(
            s_.cost.size(),
            [&](std::size_t begin, std::size_t end) {
                auto& mine = found[begin / (3 * face_chunk)];
                for (auto c = static_cast<Index>(begin); c < end; ++c) {
                    if (bits_of(s_.cost[c]) >= limit) continue;
                    const Index home = stretch(s_.tri[c]);
                    mine.push_back(
                        {key_of(s_.cost[c], c), c, stretch(s_.tri[after(c)]) == home ? home : none});
                }
            },
            3 * face_chunk);
        return found;
    }

    /// Deals the edges below the threshold out to the stretches.
    void gather(std::uint32_t limit) {
        const int bits = static_cast<int>(std::bit_width(s_.vertex_slots() - 1));
        stretch_bits_ = std::clamp(bits - stretches_bits, least_stretch, max_stretch);
        const auto found = candidates(limit);
        std::size_t count = 0;
        for (const auto& list : found) count += list.size();
        const bool alone = count > remaining() || last_steps();
        shares_.assign(alone ? 0 : stretch(static_cast<Index>(s_.vertex_slots() - 1)) + 1, {});
        for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i].territory = territory(i, i);
        crossing_.clear();
        rest_ = {};
        for (const auto& list : found)
            for (const Candidate& k : list)
                if (alone)
                    rest_.edges.push_back(k);
                else if (k.home != none)
                    shares_[k.home].edges.push_back(k);
                else
                    crossing_.push_back(crossing(k));
    }

    Territory territory(std::size_t x, std::size_t y) const {
        const auto lowest = [&](std::size_t i) { return static_cast<Index>(i << stretch_bits_); };
        return {lowest(1), lowest(x), lowest(y)};
    }

    Crossing crossing(const Candidate& k) const {
        const Index x = stretch(s_.tri[k.corner]), y = stretch(s_.tri[after(k.corner)]);
        return {std::min(x, y), std::max(x, y), k};
    }

    /// Collapses the candidates: each stretch by itself, then pairs of them, then the rest.
    void commit() {
        work_all(shares_);
        std::sort(crossing_.begin(), crossing_.end());
        for (auto& pairs : in_turns()) work_all(pairs);
        collapse_share(s_, rest_, remaining());
        join(rest_.tally);
    }

    void work_all(std::vector<Share>& shares) {
        parallel_for(
            shares.size(), [&](std::size_t i) { collapse_share(s_, shares[i], s_.live_faces); }, 1);
        for (Share& share : shares) {
            join(share.tally);
            crossing_.insert(crossing_.end(), share.crossing.begin(), share.crossing.end());
            rest_.edges.insert(rest_.edges.end(), share.rest.begin(), share.rest.end());
        }
    }

    /// Groups the crossing edges by pairs of stretches, and those into turns in which no stretch occurs
    /// twice.
    std::vector<std::vector<Share>> in_turns() {
        std::vector<std::vector<Share>> turns;
        std::vector<std::uint64_t> busy(shares_.size()); // in which turns
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

    void join(Tally& tally) {
        s_.live_faces -= tally.faces;
        s_.live_vertices -= tally.vertices;
        out_.collapses += tally.collapses;
        since_retry_ += tally.collapses;
        out_.largest = std::max(out_.largest, tally.largest);
        if (s_.log) join_logs(*s_.log, tally.log);
    }

    static void join_logs(Collapses& all, const Collapses& more) {
        const auto before = static_cast<Index>(all.wedges.size());
        for (Step step : more.steps) {
            step.wedges += before;
            all.steps.push_back(step);
        }
        all.wedges.insert(all.wedges.end(), more.wedges.begin(), more.wedges.end());
    }

    /// Edges that were refused may do now that their surroundings changed: looks at all of them once more, as
    /// long as that brought something.
    bool try_again() {
        if (100 * since_retry_ < s_.live_faces || since_retry_ == 0) return false;
        since_retry_ = 0;
        refresh_all_ = true;
        return true;
    }

    State& s_;
    Goal goal_;
    Outcome out_;
    bool refresh_all_ = false;
    std::size_t since_retry_ = 0;
    int stretch_bits_ = 0;
    std::vector<Share> shares_;      // per stretch
    std::vector<Crossing> crossing_; // between two
    Share rest_;
};

} // namespace

SimplifyResult::Blocked count_blocked(const State& s) {
    SimplifyResult::Blocked all;
    std::vector<std::uint8_t> at_seam(s.vertex_slots());
    for (Index c = 0; c < s.flags.size(); ++c)
        if (s.live(c / 3) && (s.flags[c] & feature_edge) && !(s.flags[c] & boundary_edge))
            at_seam[s.tri[c]] = at_seam[s.tri[after(c)]] = 1;
    for (Index c = 0; c < s.flags.size(); ++c) {
        if (!s.live(c / 3)) continue;
        if (s.flags[c] & blocked_border) {
            const Index u = s.tri[c], v = s.tri[after(c)];
            const bool pinned = s.kind[u] == Kind::pinned || s.kind[v] == Kind::pinned;
            ++(pinned ? all.non_manifold : at_seam[u] || at_seam[v] ? all.seams : all.borders);
        }
        all.topology += (s.flags[c] & blocked_topology) != 0;
        all.flips += (s.flags[c] & blocked_flip) != 0;
        all.error += (s.flags[c] & blocked_error) != 0;
    }
    return all;
}

Outcome& Outcome::operator+=(const Outcome& more) {
    passes += more.passes;
    collapses += more.collapses;
    largest = std::max(largest, more.largest);
    stuck = more.stuck;
    return *this;
}

Outcome run_passes(State& s, const Goal& goal) { return Passes(s, goal).run(); }

} // namespace facetmill::simplification
