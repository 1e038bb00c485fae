#pragma once
// Orders lines into chains.

#include "mesh/lines.hpp"

namespace facetmill {

struct Chain {
    std::vector<Index> points; ///< indices of Lines::points; a closed chain does not repeat the first point
    bool closed = false;
    Index material = none;
};

struct Chains {
    std::vector<Chain> chains;
    std::size_t skipped = 0; ///< lines without length, or duplicates
};

/// The chains, which use every line once. They end where a single line ends, more than two lines meet, or
/// the material changes. They are sorted by their lowest end, with closed chains last.
[[nodiscard]] Chains chains_of(const Lines& lines);

} // namespace facetmill
