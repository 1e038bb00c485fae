#pragma once
// What thicken says of a part.

#include "stages/thicken/options.hpp"

namespace facetmill {

/// The part's entry in the report, of a surface; thickness: what was asked for, in world units. Warns where
/// the solid is open, thinner than that, or runs into itself, and tells people how thick it is.
Json described(const ThickenOptions& o, const Part& part, const ThickenResult& r, double thickness,
               Context& context);
/// ... of edges that became cylinders.
Json described(const Part& part, const WiresResult& r, Context& context);

} // namespace facetmill
