#pragma once
// The report of a simplification.

#include "geometry/simplify/simplify.hpp"
#include "options/fields.hpp"

#include <string>
#include <vector>

namespace facetmill::simplify_stage {

struct SimplifyReport {
    std::vector<SimplifiedPart> parts;
};
/// Declares the fields, and the lines for the terminal: counts, the reason for the stop, the deviation. A
/// few parts get a line each; more are summarized.
void declare_simplify_report(DeclareFields<SimplifyReport>& d);

/// held_by: a phrase with the reasons why the remaining edges cannot collapse. hint_for: the advice for the
/// most frequent reason.
[[nodiscard]] std::string held_by(const SimplifyResult& r);
[[nodiscard]] std::string hint_for(const SimplifyResult& r);

} // namespace facetmill::simplify_stage
