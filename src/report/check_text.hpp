#pragma once
// Checks in words, as the renderers share them.

#include "report/record.hpp"

namespace facetmill::report {

/// "passed", "known", "failed" or "warned".
const char* outcome(const Check& check);
/// "12 places, 2 new, the first face 7 of 'part' at 1 2 3", "part 'wheel' 1200, part 'body' 800"; empty when
/// there is no evidence.
std::string places_text(const Check& check);

} // namespace facetmill::report
