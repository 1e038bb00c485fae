// The part of a pass that one worker does.

#include "geometry/simplify/share.hpp"
#include "geometry/simplify/price.hpp"

#include <memory>

namespace facetmill::simplification {

namespace {

void fetch_ends(const Work& s, Index corner) {
    for (const Index v : {s.tri[corner], s.tri[after(corner)]}) {
        if (v == none) continue;
        __builtin_prefetch(&s.first[v]);
        __builtin_prefetch(&s.touched[v]);
        __builtin_prefetch(&s.at[v]);
    }
}

void fetch_lists(const Work& s, Index corner) {
    for (const Index v : {s.tri[corner], s.tri[after(corner)]}) {
        if (v == none || s.touched[v] == s.pass || s.first[v] == none) continue;
        __builtin_prefetch(&s.tri[s.first[v]]);
        __builtin_prefetch(&s.next[s.first[v]]);
        if (!s.quadrics.empty()) __builtin_prefetch(&s.quadrics[v]);
    }
}

/// Has the cache bring what the next candidates will be asked for: they lie in no order of memory.
void fetch_ahead(const Work& s, const std::vector<Candidate>& edges, std::size_t i) {
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

} // namespace

void collapse_share(Work& s, Share& share, double error, std::size_t most) {
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
        if (collapse(s, k.corner, error, *around, pricer, share.tally) == Attempt::outside)
            hand_on(share, k, *around);
        // Two faces and one vertex a time; at a boundary one face, so the last step may need looking at
        // again.
        if (share.tally.collapses >= most) break;
    }
}

} // namespace facetmill::simplification
