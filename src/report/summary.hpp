#pragma once
// The main numbers of a stage's result in a line or two, for people on the terminal.

#include "base/json.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

/// Of measure: the totals, then a few parts when there are several, then edges and angles.
std::vector<std::string> measure_summary(const Json& result);
/// Of probe: how many answers of each kind, then the first few.
std::vector<std::string> probe_summary(const Json& result);
/// Of section: what was cut, areas and, of a single section of one part, its centroid and moments; of a stack
/// the areas times the distance beside the volume.
std::vector<std::string> section_summary(const Json& result, const std::string& unit);
/// The counts that are not zero, summed over the parts of a result: "welded vertices 12, filled holes 1"; or
/// `nothing`.
std::string counts_summary(const Json& result, const std::string& nothing);

} // namespace facetmill::report
