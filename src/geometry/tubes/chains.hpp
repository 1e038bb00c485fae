#pragma once
// Lines in the order in which they follow one another.

#include "mesh/lines.hpp"

namespace facetmill {

struct Chain {
    std::vector<Index> points; ///< into Lines::points; a closed chain does not repeat the first point
    bool closed = false;
    Index material = none;
};

struct Chains {
    std::vector<Chain> chains;
    std::size_t skipped = 0; ///< lines without length, or duplicates
};

/// Uses every line once. Chains end where one line ends, more than two meet, or the material changes. They
/// are in the order of their lowest end, closed chains last.
[[nodiscard]] Chains chains_of(const Lines& lines);

} // namespace facetmill
