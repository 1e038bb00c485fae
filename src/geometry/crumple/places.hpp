#pragma once
// Vertices by the place that they start from: what is at one place moves together.

#include "geometry/crumple/crumple.hpp"

namespace facetmill {

/// Places of all sheets, numbered by their keys.
struct CrumplePlaces {
    Index count = 0;
    std::vector<std::vector<Index>> of_vertex; ///< [sheets][vertices]

    explicit CrumplePlaces(std::span<const CrumpleSheet> sheets);
};

} // namespace facetmill
