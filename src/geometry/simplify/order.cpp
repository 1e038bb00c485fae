// The order of collapses. Each pass chooses a threshold for the costs of all edges. It collapses the edges
// below the threshold in order of cost, at most once per vertex. After each collapse it updates the costs of
// the changed edges. A cost depends only on the edge's two ends, and an untouched end keeps its quadric, so
// every cost is exact when its edge collapses.
//
// Several states share a goal through a common threshold: the costs of each are scaled to the unit of the
// largest. Only the last steps, and a pass that would overshoot the goal, collapse the edges of all states
// one by one in strict order.

#include "geometry/simplify/methods.hpp"

#include "base/progress.hpp"
#include "geometry/simplify/collapse_chunks.hpp"
#include "geometry/simplify/cost_buckets.hpp"
#include "parallel/parallel.hpp"

#include <memory>
#include <numeric>

namespace facetmill::simplification {

namespace {

constexpr std::size_t corner_chunk = 3 << 13;
constexpr double share_per_pass = 1.0 / 8; // share of the live edges that are candidates in one pass
// In buckets: near the goal, all edges of a pass cost at most four times as much as the cheapest.
constexpr std::size_t last_span = 32;
// Reasons that may no longer apply after the surroundings change.
constexpr std::uint8_t refused = blocked_topology | blocked_flip | blocked_error;
constexpr std::size_t few_corners = 512; // up to this number, costs are sorted instead of counted in buckets
// Costs of a state are not scaled below this factor, so that `never` stays infinite.
constexpr double least_factor = 1e-30;

/// A range of corners of a state. A task combines blocks of about corner_chunk corners.
struct Block {
    std::size_t member, begin, end;
};

/// An edge of any state, for the last steps.
struct LastEdge {
    std::uint64_t key;
    Index corner, member;
    bool operator<(const LastEdge& o) const { return key != o.key ? key < o.key : member < o.member; }
};

class Passes {
  public:
    Passes(std::span<Member> members, const Goal& goal)
        : members_(members), goal_(goal), changed_(members.size(), 1) {
        double largest = 0;
        for (const Member& m : members_) largest = std::max(largest, m.unit);
        factors_.reserve(members_.size());
        for (const Member& m : members_) factors_.push_back(factor(m, m.unit / largest));
    }

    void run() {
        bool stuck = false;
        count();
        const auto all = static_cast<double>(std::max<std::size_t>(1, remaining()));
        while (!stuck && !goal_.met(faces_, vertices_)) {
            lay_blocks();
            price();
            const std::uint32_t limit = threshold();
            if (limit == 0)
                stuck = !try_again();
            else
                commit(limit);
            count();
            ProgressScope::report(1 - static_cast<double>(remaining()) / all);
        }
        for (Member& m : members_) m.done.stuck = stuck;
    }

  private:
    /// The factor that brings a state's costs to the common unit. ratio: the state's unit in the common unit.
    /// Costs of quadrics are squared lengths times the (5/8)th power of an area, see cost.cpp; others are
    /// squared lengths.
    static float factor(const Member& m, double ratio) {
        const double squared = ratio * ratio, power = squared * ratio * std::sqrt(std::sqrt(ratio));
        return static_cast<float>(std::max(least_factor, m.state->quadrics ? power : squared));
    }

    /// Counts the live faces and vertices, weighted by use.
    void count() {
        faces_ = vertices_ = 0;
        for (const Member& m : members_) {
            faces_ += m.uses * m.state->rings.live_faces;
            vertices_ += m.uses * m.state->rings.live_vertices;
        }
    }

    /// The number of collapses to the goal, if each removes two faces and one vertex.
    std::size_t remaining(std::size_t faces, std::size_t vertices) const {
        if (goal_.met(faces, vertices)) return 0;
        return std::min((faces - goal_.faces + 1) / 2, vertices - goal_.vertices);
    }
    std::size_t remaining() const { return remaining(faces_, vertices_); }
    /// True if the goal is so close that one worker finishes, in strict order.
    bool last_steps() const { return remaining() <= std::max<std::size_t>(256, faces_ / 64); }

    void lay_blocks() {
        blocks_.clear();
        first_block_.clear();
        tasks_.assign(1, 0);
        std::size_t in_task = 0;
        for (std::size_t m = 0; m < members_.size(); ++m) {
            first_block_.push_back(blocks_.size());
            const std::size_t corners = members_[m].state->edges.cost.size();
            for (std::size_t c = 0; c < corners; c += corner_chunk) {
                const std::size_t end = std::min(corners, c + corner_chunk);
                if (in_task > 0 && in_task + end - c > corner_chunk) {
                    tasks_.push_back(blocks_.size());
                    in_task = 0;
                }
                blocks_.push_back({m, c, end});
                in_task += end - c;
            }
        }
        first_block_.push_back(blocks_.size());
        tasks_.push_back(blocks_.size());
    }

    template <class Body>
    void for_blocks(Body&& body) const {
        parallel_for(
            tasks_.size() - 1,
            [&](std::size_t t) {
                for (std::size_t b = tasks_[t]; b < tasks_[t + 1]; ++b) body(b);
            },
            1);
    }
    /// Calls body(m) for all members; groups small members into one task.
    template <class Body>
    void for_members(Body&& body) const {
        parallel_for(members_.size(), body, std::clamp<std::size_t>(members_.size() / 256, 1, 64));
    }

    void price() {
        const bool all = std::exchange(refresh_all_, false);
        for_members([&](std::size_t m) {
            ++members_[m].done.passes;
            ++members_[m].state->order.pass;
            if (all) price_all(*members_[m].state);
        });
        if (all) return;
        for_blocks([&](std::size_t b) {
            if (changed_[blocks_[b].member]) price_dirty(blocks_[b]);
        });
    }

    /// Retries refused edges that have a neighbour changed in the last pass.
    void price_dirty(const Block& block) {
        State& s = *members_[block.member].state;
        Pricer pricer(s);
        for (auto c = static_cast<Index>(block.begin); c < block.end; ++c) {
            if (!(s.edges.flags[c] & refused) || !s.live(c / 3)) continue;
            const Index u = s.tri[c], v = s.tri[after(c)];
            if (s.order.dirty[u] == s.order.pass - 1 || s.order.dirty[v] == s.order.pass - 1) pricer(c, u, v);
        }
        pricer.finish();
    }

    /// The threshold as the bits of a cost: edges with lower costs are candidates. 0 if no edge is left.
    std::uint32_t threshold() const {
        const std::vector<Bucket> filled = blocks_corners() <= few_corners ? few_buckets() : all_buckets();
        if (filled.empty()) return 0;
        std::size_t live = 0;
        for (const Bucket& b : filled) live += b.edges;
        const auto share = static_cast<std::size_t>(static_cast<double>(live) * share_per_pass);
        const std::size_t wanted =
            last_steps() ? 4 * remaining() + 64 : std::clamp<std::size_t>(share, 64, remaining());
        return cost_limit(filled, wanted, last_steps() ? filled.front().number + last_span : buckets);
    }

    std::size_t blocks_corners() const {
        std::size_t corners = 0;
        for (const Block& b : blocks_) corners += b.end - b.begin;
        return corners;
    }

    static std::size_t bucket_of(float cost) { return bits_of(cost) >> bucket_shift; }

    /// Non-empty buckets, ascending. For few edges, sorting is cheaper than a histogram.
    std::vector<Bucket> few_buckets() const {
        std::vector<Bucket> filled;
        for (const Block& block : blocks_) {
            const Member& m = members_[block.member];
            for (std::size_t c = block.begin; c < block.end; ++c)
                if (const auto b = bucket_of(m.state->edges.cost[c] * factors_[block.member]); b < buckets)
                    filled.push_back({b, m.uses});
        }
        return gathered(std::move(filled));
    }

    /// Non-empty buckets, ascending, for any number of edges.
    std::vector<Bucket> all_buckets() const {
        const std::vector<std::size_t> all = histogram();
        std::vector<Bucket> filled;
        for (std::size_t b = 0; b < buckets; ++b)
            if (all[b] > 0) filled.push_back({b, all[b]});
        return filled;
    }

    /// The number of edges per bucket of cost.
    std::vector<std::size_t> histogram() const {
        using Counts = std::vector<std::size_t>;
        return parallel_reduce(
            tasks_.size() - 1, Counts(buckets),
            [&](std::size_t task, std::size_t) {
                Counts counts(buckets + 1); // the last one counts `never`
                for (std::size_t b = tasks_[task]; b < tasks_[task + 1]; ++b) {
                    const Member& m = members_[blocks_[b].member];
                    const float factor = factors_[blocks_[b].member];
                    for (std::size_t c = blocks_[b].begin; c < blocks_[b].end; ++c)
                        counts[bucket_of(m.state->edges.cost[c] * factor)] += m.uses;
                }
                counts.pop_back();
                return counts;
            },
            [](Counts a, const Counts& b) {
                for (std::size_t i = 0; i < buckets; ++i) a[i] += b[i];
                return a;
            },
            1);
    }

    /// The edges below the threshold, by block.
    std::vector<std::vector<Candidate>> candidates(std::uint32_t limit) const {
        std::vector<std::vector<Candidate>> found(blocks_.size());
        for_blocks([&](std::size_t b) {
            const State& s = *members_[blocks_[b].member].state;
            const float factor = factors_[blocks_[b].member];
            const int bits = stretch_bits(s);
            for (auto c = static_cast<Index>(blocks_[b].begin); c < blocks_[b].end; ++c) {
                const float cost = s.edges.cost[c] * factor;
                if (bits_of(cost) >= limit) continue;
                const Index home = s.tri[c] >> bits;
                found[b].push_back({key_of(cost, c), c, s.tri[after(c)] >> bits == home ? home : none});
            }
        });
        return found;
    }

    void commit(std::uint32_t limit) {
        const auto found = candidates(limit);
        std::size_t count = 0;
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            count += members_[blocks_[b].member].uses * found[b].size();
        std::vector<PassTotals> totals(members_.size());
        std::vector<LastEdge> edges;
        if (count > remaining() || last_steps())
            for (std::size_t b = 0; b < blocks_.size(); ++b) append(edges, found[b], blocks_[b].member);
        else
            collapse_disjoint(found, totals, edges);
        if (!edges.empty()) collapse_in_order(std::move(edges), totals);
        for (std::size_t m = 0; m < members_.size(); ++m) {
            changed_[m] = totals[m].collapses > 0;
            members_[m].done.collapses += totals[m].collapses;
            members_[m].done.largest = std::max(members_[m].done.largest, totals[m].largest);
            since_retry_ += members_[m].uses * totals[m].collapses;
            State& s = *members_[m].state;
            if (10 * s.rings.live_faces < 6 * s.face_slots()) compact(s);
        }
    }

    static void append(std::vector<LastEdge>& edges, const std::vector<Candidate>& more, std::size_t member) {
        for (const Candidate& k : more) edges.push_back({k.key, k.corner, static_cast<Index>(member)});
    }

    /// Collapses each state independently. later: topology changes, which may remove more faces than
    /// expected.
    void collapse_disjoint(const std::vector<std::vector<Candidate>>& found, std::vector<PassTotals>& totals,
                           std::vector<LastEdge>& later) {
        for_members([&](std::size_t m) {
            const auto lists =
                std::span(found).subspan(first_block_[m], first_block_[m + 1] - first_block_[m]);
            if (std::all_of(lists.begin(), lists.end(), [](const auto& list) { return list.empty(); }))
                return;
            State& s = *members_[m].state;
            const std::size_t uses = members_[m].uses, other_faces = faces_ - uses * s.rings.live_faces,
                              other_vertices = vertices_ - uses * s.rings.live_vertices;
            const auto most = [&] { // estimates the remaining number as if the other states did not change
                const std::size_t left = remaining(other_faces + uses * s.rings.live_faces,
                                                   other_vertices + uses * s.rings.live_vertices);
                return (left + uses - 1) / uses;
            };
            totals[m] = collapse_in_chunks(s, lists, most);
        });
        for (std::size_t m = 0; m < members_.size(); ++m) append(later, totals[m].later, m);
        count();
    }

    /// Collapses edges of all states in a single order, until the goal is met.
    void collapse_in_order(std::vector<LastEdge> edges, std::vector<PassTotals>& totals) {
        std::sort(edges.begin(), edges.end());
        const auto around = std::make_unique_for_overwrite<Around>();
        std::vector<Tally> tallies(members_.size());
        const std::size_t most = remaining();
        std::size_t done = 0;
        const auto state_of = [&](const LastEdge& e) -> State& { return *members_[e.member].state; };
        std::size_t faces = faces_, vertices = vertices_;
        for (std::size_t i = 0; i < edges.size() && done < most && !goal_.met(faces, vertices); ++i) {
            fetch_ahead(edges, i, state_of);
            State& s = state_of(edges[i]);
            if (!is_open(s, edges[i].corner)) continue;
            Pricer pricer(s);
            Tally& tally = tallies[edges[i].member];
            const std::size_t uses = members_[edges[i].member].uses, faces_gone = tally.faces,
                              vertices_gone = tally.vertices;
            // A collapse normally removes two faces and one vertex. At a boundary it removes one face, so
            // another pass may be needed. A vanishing part loses four faces and all its vertices, so the
            // removed numbers are counted.
            if (collapse(s, edges[i].corner, *around, pricer, tally) != Attempt::done) continue;
            done += uses;
            faces -= uses * (tally.faces - faces_gone);
            vertices -= uses * (tally.vertices - vertices_gone);
        }
        for (std::size_t m = 0; m < members_.size(); ++m) join(*members_[m].state, tallies[m], totals[m]);
    }

    /// Schedules a retry of refused edges, because their surroundings may have changed. Repeats only while
    /// the last retry led to enough collapses.
    bool try_again() {
        if (100 * since_retry_ < faces_ || since_retry_ == 0) return false;
        since_retry_ = 0;
        refresh_all_ = true;
        return true;
    }

    std::span<Member> members_;
    Goal goal_;
    std::vector<float> factors_;           // [members] cost factors
    std::vector<std::uint8_t> changed_;    // [members] true if the last pass changed it
    std::vector<Block> blocks_;            // blocks of all members, in order
    std::vector<std::size_t> first_block_; // [members + 1] index of the first block
    std::vector<std::size_t> tasks_;       // the first block of each task, and the end
    std::size_t faces_ = 0, vertices_ = 0; // totals, weighted by use
    bool refresh_all_ = true;
    std::size_t since_retry_ = 0;
};

} // namespace

SimplifyResult::Blocked count_blocked(const State& s) {
    SimplifyResult::Blocked all;
    std::vector<std::uint8_t> at_seam(s.vertex_slots());
    for (Index c = 0; c < s.edges.flags.size(); ++c)
        if (s.live(c / 3) && (s.edges.flags[c] & feature_edge) && !(s.edges.flags[c] & boundary_edge))
            at_seam[s.tri[c]] = at_seam[s.tri[after(c)]] = 1;
    for (Index c = 0; c < s.edges.flags.size(); ++c) {
        if (!s.live(c / 3)) continue;
        if (s.edges.flags[c] & blocked_border) {
            const Index u = s.tri[c], v = s.tri[after(c)];
            const bool pinned = s.features->kind[u] == Kind::pinned || s.features->kind[v] == Kind::pinned;
            ++(pinned ? all.non_manifold : at_seam[u] || at_seam[v] ? all.seams : all.borders);
        }
        all.topology += (s.edges.flags[c] & blocked_topology) != 0;
        all.flips += (s.edges.flags[c] & blocked_flip) != 0;
        all.error += (s.edges.flags[c] & blocked_error) != 0;
    }
    return all;
}

void run_passes(std::span<Member> members, const Goal& goal) { Passes(members, goal).run(); }

Outcome run_passes(State& s, const Goal& goal) {
    Member alone{&s};
    run_passes(std::span(&alone, 1), goal);
    return alone.done;
}

} // namespace facetmill::simplification
