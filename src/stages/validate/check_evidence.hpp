#pragma once
// What speaks against an assertion, as checks carry it.

#include "geometry/inspect/evidence.hpp"
#include "report/record.hpp"
#include "stage/assertions.hpp"

namespace facetmill::validate_stage {

/// Entries of evidence that a check carries at most.
constexpr std::size_t max_evidence = 10;

/// The first locations in the world, ten at most: [{part, at, face}], of pairs of faces that meet also
/// {with}, of attributes also {attribute}. Against closedness and about the boundary, one entry for each of
/// its chains:
/// [{part, at, face, loop, edges, length}], the loops numbered from 0 by their lowest vertex, at the middle
/// of their first edge. For a number that no location speaks against, what it is of the parts, those that
/// count most first: [{part, amount}]; for a box also {at}, its corner that is out; for parts and materials
/// their names.
report::CheckEvidence evidence_against(const Scene& scene, const Assertion& assertion);

/// The first locations, likewise, of which the ascending keys tell.
report::CheckEvidence evidence_among(const Scene& scene, const Assertion& assertion,
                                     const std::vector<std::uint64_t>& keys);

/// How many locations speak against it, where its value does not tell that; none where there are none.
std::optional<std::size_t> count_locations(const Scene& scene, const Assertion& assertion);

/// All locations on one part (up to 2^22), in the part's own space: of what faces have, those beyond the
/// bound.
std::vector<Location> locations_against(const Part& part, const Assertion& assertion);

/// What the locations of all parts are known by, ascending, equal ones as often as there are: hashes of
/// positions in the parts' own spaces (Location::key) and of the parts' names.
std::vector<std::uint64_t> location_keys(const Scene& scene, const Assertion& assertion);

} // namespace facetmill::validate_stage
