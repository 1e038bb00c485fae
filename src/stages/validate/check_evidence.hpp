#pragma once
// Evidence against an assertion, as checks carry it.

#include "geometry/inspect/evidence.hpp"
#include "report/record.hpp"
#include "stage/assertions.hpp"

namespace facetmill::validate_stage {

/// The maximum number of evidence entries of a check.
constexpr std::size_t max_evidence = 10;

/// At most the first ten locations in world space: [{part, at, face}], with {with} for pairs of faces and
/// {attribute} for attributes. For closedness and the boundary, an entry for each boundary chain: [{part,
/// at, face, loop, edges, length}]. Loops are numbered from 0 by their lowest vertex, and `at` is the middle
/// of their first edge. Numbers without locations give the parts' values, the most influential first:
/// [{part, amount}]. A box adds {at}, its corner that is out of bounds; parts and materials give their
/// names.
[[nodiscard]] report::CheckEvidence evidence_against(const Scene& scene, const Assertion& assertion);

/// The first locations in the same form, limited to locations with these keys (ascending).
[[nodiscard]] report::CheckEvidence evidence_among(const Scene& scene, const Assertion& assertion,
                                                   const std::vector<std::uint64_t>& keys);

/// The number of locations, if it is not the value itself; none if the assertion has no locations.
[[nodiscard]] std::optional<std::size_t> count_locations(const Scene& scene, const Assertion& assertion);

/// All locations on a part (up to 2^22), in the part's own space; for properties of faces, the faces beyond
/// the bound.
[[nodiscard]] std::vector<Location> locations_against(const Part& part, const Assertion& assertion);

/// The keys of the locations of all parts, ascending, with repeats. They hash positions in the parts' own
/// spaces (Location::key) and the parts' names.
[[nodiscard]] std::vector<std::uint64_t> location_keys(const Scene& scene, const Assertion& assertion);

} // namespace facetmill::validate_stage
