#pragma once
// The part of a pass that one worker does.

#include "geometry/simplify/around.hpp"

namespace facetmill::simplification {

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

/// Collapses the edges of a share in order of cost, at most so many, none at a vertex that the pass touched.
/// error: Goal::error.
void collapse_share(Work& s, Share& share, double error, std::size_t most);

} // namespace facetmill::simplification
