#pragma once
// The evidence in a check against an assertion.

#include "geometry/inspect/evidence.hpp"
#include "report/record.hpp"
#include "stage/assertions.hpp"

namespace facetmill::validate_stage {

/// The maximum number of evidence entries of a check.
constexpr std::size_t max_evidence = 10;

/// Lists at most the first ten locations, in world space: [{part, at, face}]. Pairs of faces add {with}, and
/// attributes add {attribute}. Closedness and the boundary have an entry for each boundary chain: [{part,
/// at, face, loop, edges, length}]. Loops are numbered from 0 by their lowest vertex, and `at` is the middle
/// of their first edge. Numbers without locations list the values of the parts, the most influential part
/// first: [{part, amount}]. A box adds {at}, the corner that is out of bounds. Parts and materials list
/// their names.
[[nodiscard]] report::CheckEvidence evidence_against(const Scene& scene, const Assertion& assertion);

/// The evidence against a failed assertion, and the number of its locations (count_locations).
struct Findings {
    report::CheckEvidence evidence;
    std::optional<std::size_t> locations;
};
/// Finds both, with one measurement of properties of faces.
[[nodiscard]] Findings findings_against(const Scene& scene, const Assertion& assertion);

/// The evidence at only the locations with these keys (ascending).
[[nodiscard]] report::CheckEvidence evidence_among(const Scene& scene, const Assertion& assertion,
                                                   const std::vector<std::uint64_t>& keys);

/// The number of locations. None if the assertion has no locations, or if its value is this number.
[[nodiscard]] std::optional<std::size_t> count_locations(const Scene& scene, const Assertion& assertion);

/// All locations on a part (up to 2^22), in the part's own space; properties of faces list the faces beyond
/// the bound.
[[nodiscard]] std::vector<Location> locations_against(const Part& part, const Assertion& assertion);

/// The keys of the locations of all parts, ascending, with repeats. They hash positions in the parts' own
/// spaces (Location::key) and the parts' names.
[[nodiscard]] std::vector<std::uint64_t> location_keys(const Scene& scene, const Assertion& assertion);

} // namespace facetmill::validate_stage
