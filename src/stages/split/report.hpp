#pragma once
// What split says of a part.

#include "stages/split/options.hpp"

namespace facetmill {

/// The part's entry in the report.
Json described(const SplitOptions& o, const Part& part, const SplitResult& r, const FacetShape& before,
               const FacetShape& after);

/// Says which target was not reached; `longest`: the longest edge that is left, in world units.
void warn_of_targets(const Part& part, const SplitResult& r, const SplitSettings& s, double longest,
                     Context& context);
/// Says where faces cannot be split as well as the stage promises.
void warn_of_spots(const Part& part, const SplitResult& r, SplitMethod method, Context& context);

} // namespace facetmill
