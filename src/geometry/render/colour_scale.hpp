#pragma once
// Colours for numbers and for identifiers.

#include "geometry/render/canvas.hpp"
#include "geometry/render/colour_range.hpp"

namespace facetmill {

/// A palette of colours that are easy to distinguish; the identifier selects the colour.
[[nodiscard]] Colour distinct_colour(std::uint64_t number);

/// The colour of missing numbers: pink, which differs from all scales and from inner sides.
inline constexpr Colour missing_colour{0.79f, 0.10f, 0.51f};

/// The colour map "viridis" for 0 to 1, perceptually uniform (S. van der Walt and N. Smith, 2015), by M.
/// Zucker's polynomials. Values outside this range get the end colours, and NaN gets missing_colour.
[[nodiscard]] Colour on_a_scale(double t);

/// The colour for 0 to 1: from blue over light grey at 0.5 to red (K. Moreland, "Diverging color maps for
/// scientific visualization", 2009). Other values as in on_a_scale.
[[nodiscard]] Colour on_a_diverging_scale(double t);

/// The colour on the scale that fits the range.
[[nodiscard]] Colour on_the_scale_of(const ValueRange& range, double t);

/// The position of x in the range, 0 to 1 inside; 0.5 if the range is a point; NaN if x is not finite.
[[nodiscard]] double in_range(double x, const ValueRange& range);

} // namespace facetmill
