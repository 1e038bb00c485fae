// The order of collapses. One pass: costs of all edges whose ends changed, a global threshold on them, and
// the edges below it collapsed in order of cost, none twice at a vertex. Costs depend on an edge's two ends
// only, and an untouched end keeps its quadric, so every cost is exact when its edge collapses.
//
// The vertices are cut into stretches of the Morton curve. Edges whose surroundings lie within one stretch
// are collapsed by one worker per stretch, the few others by one worker after them: no two workers ever touch
// the same vertex or face, and the result does not depend on how many there are.

#include "base/parallel.hpp"
#include "geometry/simplify_work.hpp"

#include <atomic>
#include <bit>

namespace facetmill::simplification {

namespace {

constexpr std::size_t face_chunk = 1 << 15;
constexpr int stretch_bits = 13;           // vertices of a stretch: 8192
constexpr double share_per_pass = 1.0 / 8; // of the live edges that are candidates in one pass
constexpr int bucket_shift = 19;           // of a cost's bits: 16 buckets per power of two
constexpr std::uint8_t refused =
    blocked_topology | blocked_flip | blocked_error; // as their surroundings were
constexpr std::size_t last_span =
    32; // buckets: near the goal, no edge goes before one of a quarter of its cost
constexpr std::size_t buckets = std::size_t{0x7f800000u >> bucket_shift} + 1;

/// Edges by cost; equal ones in an order that is spread over the surface.
struct Candidate {
    std::uint64_t key;
    Index corner;
    bool operator<(const Candidate& other) const { return key < other.key; }
};

std::uint32_t bits_of(float cost) { return std::bit_cast<std::uint32_t>(cost); }
/// A bijection of 32 bits, so that keys stay distinct.
std::uint32_t scattered(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
Candidate candidate(float cost, Index c) { return {(std::uint64_t{bits_of(cost)} << 32) | scattered(c), c}; }

class Passes {
  public:
    Passes(Work& s, const Goal& goal) : s_(s), goal_(goal) {}

    Outcome run() {
        refresh_all_ = true;
        while (!met()) {
            ++out_.passes, ++s_.pass;
            price();
            const std::uint32_t limit = threshold();
            if (limit == 0) {
                if (!try_again()) return out_.stuck = true, out_;
                continue;
            }
            gather(limit);
            commit();
            if (10 * s_.live_faces < 6 * s_.face_slots()) compact(s_);
        }
        return out_;
    }

  private:
    bool met() const { return s_.live_faces <= goal_.faces || s_.live_vertices <= goal_.vertices; }
    /// Collapses to go, if each takes two faces and one vertex.
    std::size_t remaining() const {
        return std::min((s_.live_faces - goal_.faces + 1) / 2, s_.live_vertices - goal_.vertices);
    }
    /// So near the goal that one worker finishes, in strict order.
    bool last_steps() const { return remaining() <= std::max<std::size_t>(256, s_.live_faces / 64); }
    Index stretch(Index v) const { return v >> stretch_bits; }

    /// Costs of the edges that changed since the last pass, a histogram of all costs, and the vertices that
    /// have a neighbour in another stretch.
    void price() {
        outer_.assign(s_.vertex_slots(), 0);
        histograms_.assign((s_.face_slots() + face_chunk - 1) / face_chunk, {});
        parallel_chunks(
            s_.face_slots(),
            [&](std::size_t begin, std::size_t end) {
                auto& histogram = histograms_[begin / face_chunk];
                histogram.assign(buckets, 0);
                for (std::size_t f = begin; f < end; ++f)
                    if (s_.live(static_cast<Index>(f))) price_face(static_cast<Index>(f), histogram);
            },
            face_chunk);
        refresh_all_ = false;
    }

    void price_face(Index f, std::vector<Index>& histogram) {
        const Index a = s_.tri[3 * f], b = s_.tri[3 * f + 1], c = s_.tri[3 * f + 2];
        if (stretch(a) != stretch(b) || stretch(b) != stretch(c))
            for (const Index v : {a, b, c}) std::atomic_ref(outer_[v]).store(1, std::memory_order_relaxed);
        for (Index corner = 3 * f; corner < 3 * f + 3; ++corner) {
            const Index u = s_.tri[corner], v = s_.tri[after(corner)];
            if (refresh_all_ || changed(s_.touched, u, v) ||
                ((s_.flags[corner] & refused) && changed(s_.stirred, u, v)))
                price_edge(corner, u, v);
            if (s_.cost[corner] < never) ++histogram[bits_of(s_.cost[corner]) >> bucket_shift];
        }
    }

    bool changed(const std::vector<std::uint32_t>& when, Index u, Index v) const {
        return when[u] == s_.pass - 1 || when[v] == s_.pass - 1;
    }

    void price_edge(Index corner, Index u, Index v) {
        std::uint8_t flags = s_.flags[corner] & static_cast<std::uint8_t>(~blocked);
        s_.cost[corner] = never;
        // The other face of the edge has the corner that runs the other way; a boundary edge has none.
        if (u < v || (flags & boundary_edge)) {
            const float cost = static_cast<float>(place(s_, corner, flags).cost);
            if (cost < never)
                s_.cost[corner] = cost; // false for what is no number too
            else
                flags |= blocked_border;
        }
        s_.flags[corner] = flags;
    }

    /// Bits of a cost: edges below are candidates. 0 when no edge is left.
    std::uint32_t threshold() {
        std::size_t live = 0, below = 0;
        std::vector<std::size_t> all(buckets);
        for (const auto& h : histograms_)
            for (std::size_t i = 0; i < buckets; ++i) all[i] += h[i], live += h[i];
        if (live == 0) return 0;
        const auto share = static_cast<std::size_t>(static_cast<double>(live) * share_per_pass);
        const std::size_t wanted =
            last_steps() ? 4 * remaining() + 64 : std::clamp<std::size_t>(share, 64, remaining());
        std::size_t i = 0, cheapest = buckets;
        for (; i < buckets; ++i) {
            if (below > 0 && (below + all[i] > wanted || (last_steps() && i > cheapest + last_span))) break;
            if (below == 0 && all[i] > 0) cheapest = i;
            below += all[i];
        }
        return std::min(static_cast<std::uint32_t>(i) << bucket_shift, bits_of(never));
    }

    /// Sorts the edges below the threshold into the stretches and the rest.
    void gather(std::uint32_t limit) {
        const std::size_t chunks = histograms_.size();
        std::vector<std::vector<Candidate>> found(chunks);
        parallel_chunks(
            s_.face_slots(),
            [&](std::size_t begin, std::size_t end) {
                auto& mine = found[begin / face_chunk];
                for (std::size_t c = 3 * begin; c < 3 * end; ++c)
                    if (bits_of(s_.cost[c]) < limit && s_.live(static_cast<Index>(c / 3)))
                        mine.push_back(candidate(s_.cost[c], static_cast<Index>(c)));
            },
            face_chunk);
        for (auto& list : inner_) list.clear();
        inner_.resize(stretch(static_cast<Index>(s_.vertex_slots() - 1)) + 1);
        rest_.clear();
        std::size_t count = 0;
        for (const auto& list : found) count += list.size();
        const bool alone = count > remaining() || last_steps();
        for (const auto& list : found)
            for (const Candidate& k : list) {
                const Index u = s_.tri[k.corner], v = s_.tri[after(k.corner)];
                if (alone || outer_[u] || outer_[v])
                    rest_.push_back(k);
                else
                    inner_[stretch(u)].push_back(k);
            }
    }

    /// Collapses the candidates: each stretch by itself, then the rest.
    void commit() {
        std::vector<Tally> tallies(inner_.size());
        std::vector<std::uint32_t> used(inner_.size());
        parallel_for(
            inner_.size(), [&](std::size_t i) { used[i] = work(inner_[i], tallies[i], s_.live_faces); }, 1);
        for (const auto u : used) s_.stamp = std::max(s_.stamp, u);
        for (auto& tally : tallies) join(tally);
        Tally tally;
        s_.stamp = work(rest_, tally, remaining());
        join(tally);
        if (s_.stamp > UINT32_MAX / 2) s_.mark.assign(s_.mark.size(), 0), s_.stamp = 0;
    }

    /// Returns the first stamp that was not used.
    std::uint32_t work(std::vector<Candidate>& list, Tally& tally, std::size_t most) {
        std::sort(list.begin(), list.end());
        auto rings = std::make_unique<Rings>();
        std::uint32_t stamp = s_.stamp;
        for (const Candidate& k : list) {
            if (!s_.live(k.corner / 3)) continue;
            const Index u = s_.tri[k.corner], v = s_.tri[after(k.corner)];
            if (s_.touched[u] == s_.pass || s_.touched[v] == s_.pass) continue;
            collapse(s_, k.corner, goal_.error, stamp += 2, *rings, tally);
            // Two faces and one vertex a time; at a boundary one face, so the last step may need looking at
            // again.
            if (tally.collapses >= most) break;
        }
        return stamp + 2;
    }

    void join(Tally& tally) {
        s_.live_faces -= tally.faces;
        s_.live_vertices -= tally.vertices;
        out_.collapses += tally.collapses, since_retry_ += tally.collapses;
        out_.largest = std::max(out_.largest, tally.largest);
        join_logs(tally.log);
    }

    void join_logs(const Log& from) {
        const auto before = static_cast<Index>(s_.log.wedges.size());
        for (Step step : from.steps) step.wedges += before, s_.log.steps.push_back(step);
        s_.log.wedges.insert(s_.log.wedges.end(), from.wedges.begin(), from.wedges.end());
    }

    /// Edges that were refused may do now that their surroundings changed: looks at all of them once more, as
    /// long as that brought something.
    bool try_again() {
        if (100 * since_retry_ < s_.live_faces || since_retry_ == 0) return false;
        since_retry_ = 0;
        return refresh_all_ = true;
    }

    Work& s_;
    Goal goal_;
    Outcome out_;
    bool refresh_all_ = false;
    std::size_t since_retry_ = 0;
    std::vector<std::uint8_t> outer_;            // vertices with a neighbour in another stretch
    std::vector<std::vector<Index>> histograms_; // per chunk of faces
    std::vector<std::vector<Candidate>> inner_;  // per stretch
    std::vector<Candidate> rest_;
};

} // namespace

SimplifyResult::Blocked count_blocked(const Work& s) {
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

Outcome run_passes(Work& s, const Goal& goal) { return Passes(s, goal).run(); }

} // namespace facetmill::simplification
