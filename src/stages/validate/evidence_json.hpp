#pragma once
// What speaks against a property, as checks carry it.

#include "stage/assertions.hpp"

#include "base/json.hpp"

namespace facetmill {

/// The first places in the world, ten at most: [{part, at, face}], of pairs of faces that meet
/// also {with}, of attributes also {attribute}. Against closedness and about borders, one
/// entry for each open chain: [{part, at, face, loop, edges, length}], the loops numbered from 0 by their
/// lowest vertex, at the middle of their first edge. For a number that no place speaks against, what it is of
/// the parts, those that count most first: [{part, amount}]; for a box also {at}, its corner that is out; for
/// parts and materials their names.
Json evidence_against(const Scene& scene, const Assertion& assertion);

/// The first places, likewise, of which the ascending keys tell.
Json evidence_among(const Scene& scene, const Assertion& assertion, const std::vector<std::uint64_t>& keys);

/// How many places speak against a truth, or against a measure that each face has (faces beyond the bound);
/// none for properties that are counts themselves, and those without places.
std::optional<std::size_t> count_places(const Scene& scene, const Assertion& assertion);

/// No more places than this are looked at on one part.
constexpr std::size_t most_places = std::size_t{1} << 22;

/// The places on one part, in the part's own space: of a measure that faces have only those beyond the bound.
std::vector<Place> places_against(const Part& part, const Assertion& assertion, std::size_t limit);

/// What the places of all parts are known by, ascending, equal ones as often as there are: hashes of
/// positions in the parts' own spaces (geometry/inspect/place_keys.hpp) and of the parts' names.
std::vector<std::uint64_t> place_keys(const Scene& scene, const Assertion& assertion);

} // namespace facetmill
