#pragma once
// Lines in the order in which they follow one another.

#include "mesh/lines.hpp"

namespace facetmill {

struct Chain {
    std::vector<Index> points; ///< into Lines::points; of a closed one the first is not repeated
    bool closed = false;
    Index material = none;
};

struct Chains {
    std::vector<Chain> chains;
    std::size_t skipped = 0; ///< lines without length, or that are there twice
};

/// Every line once. Chains end where one line ends, more than two meet, or the material changes; they are in
/// the order of their lowest end, closed ones last.
Chains chains_of(const Lines& lines);

} // namespace facetmill
