#pragma once
// Colours for numbers and for identifiers.

#include "geometry/render/canvas.hpp"

namespace facetmill {

/// Colours that are told apart; the number of an identifier chooses one.
Colour distinct_colour(std::uint64_t number);

/// The map "viridis" (S. van der Walt and N. Smith, 2015), whose steps look equal, for 0 to 1, by M. Zucker's
/// polynomials; what lies beyond has the colour of the end. Grey for what is not a number.
Colour on_a_scale(double t);

/// Where x lies in the range, 0 to 1 inside; 0.5 when the range is a point.
double in_range(double x, const ValueRange& range);

} // namespace facetmill
