#pragma once
// What clean did, and what it did not, for reports.

#include "base/json.hpp"
#include "geometry/clean/clean.hpp"

namespace facetmill::report {

/// Every count by its name.
Json counts_json(const CleanCounts& counts);
/// The first few repairs not done, [{step, why, at}], in the world.
Json not_done_json(const std::vector<NotDone>& all, const Transform& to_world);

} // namespace facetmill::report
