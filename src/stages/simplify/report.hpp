#pragma once
// A simplification as reports have it.

#include "geometry/simplify/simplify.hpp"
#include "options/fields.hpp"

#include <string>
#include <vector>

namespace facetmill::simplify_stage {

struct SimplifyReport {
    std::vector<SimplifiedPart> parts;
};
/// Lines for the terminal: counts, what stopped it, the deviation. A few parts one by one, more of them
/// together.
void declare_simplify_report(DeclareFields<SimplifyReport>& d);

/// What holds the edges that are left, as a phrase; and what can be done about most of them.
[[nodiscard]] std::string held_by(const SimplifyResult& r);
[[nodiscard]] std::string hint_for(const SimplifyResult& r);

} // namespace facetmill::simplify_stage
