#pragma once
// A simplification as reports have it.

#include "base/json.hpp"
#include "geometry/inspect.hpp"
#include "geometry/simplify.hpp"

namespace facetmill::report {

/// Counts before and after, the target that stopped it, errors, what holds the edges that are left, and what
/// was measured. Lengths times scale, which takes them from the part's space to the scene's.
Json simplify_json(const SimplifyResult& r, double scale);

/// {before, after} of what topology is, for methods that may change it.
Json topology_change_json(const Properties& before, const Properties& after);

/// What holds the edges that are left, as a phrase.
std::string held_by(const SimplifyResult& r);

} // namespace facetmill::report
