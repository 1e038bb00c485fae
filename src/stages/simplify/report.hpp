#pragma once
// A simplification as reports have it.

#include "base/json.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/simplify/simplify.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

/// Counts before and after, the target that stopped it, errors, what holds the edges that are left, and what
/// was measured. Lengths times scale, which takes them from the part's space to the scene's.
Json simplify_json(const SimplifyResult& r, double scale);

/// {before, after} of what topology is, for methods that may change it.
Json topology_change_json(const Properties& before, const Properties& after);

/// What holds the edges that are left, as a phrase; and what can be done about most of them.
std::string held_by(const SimplifyResult& r);
std::string way_out(const SimplifyResult& r);

/// Lines for the terminal, of the stage's result: counts, what stopped it, the deviation. A few parts one by
/// one, more of them together.
std::vector<std::string> simplify_summary(const Json& result);

} // namespace facetmill::report
