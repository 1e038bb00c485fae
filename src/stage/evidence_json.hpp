#pragma once
// What speaks against a property, as checks carry it.

#include "stage/assertions.hpp"

#include "base/json.hpp"

namespace facetmill {

/// The first places in the world, ten at most: [{part, at, face}], of pairs of faces that meet
/// also {with}. Against closedness and about borders, one
/// entry for each open chain: [{part, at, face, loop, edges, length}], the loops numbered from 0 by their
/// lowest vertex, at the middle of their first edge.
Json evidence_against(const Scene& scene, const Assertion& assertion);

/// How many places speak against a truth, or against a measure that each face has (faces beyond the bound);
/// none for properties that are counts themselves, and those without places.
std::optional<std::size_t> count_places(const Scene& scene, const Assertion& assertion);

/// The places on one part, in the part's own space: of a measure that faces have only those beyond the bound.
std::vector<Place> places_against(const Part& part, const Assertion& assertion, std::size_t limit);

} // namespace facetmill
