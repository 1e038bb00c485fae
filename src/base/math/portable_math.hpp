#pragma once
// Our own transcendental functions, because libm's results depend on the processor, and outputs must not.
// They use only + - x / sqrt; the accuracy of each is stated, and tested against libm.

namespace facetmill {

inline constexpr double pi = 3.141592653589793238462643383279502884;

[[nodiscard]] double sine(double x);        ///< |error| < 1e-15 for |x| < 1e5
[[nodiscard]] double cosine(double x);      ///< |error| < 1e-15 for |x| < 1e5
[[nodiscard]] double exponential(double x); ///< relative error < 4e-16 in [-700, 700]; 0 and inf outside
[[nodiscard]] double logarithm(double x);   ///< relative error < 4e-16 for positive normal x
[[nodiscard]] double arc_tangent(double y, double x); ///< atan2, |error| < 1e-15
[[nodiscard]] double arc_cosine(double x);            ///< |error| < 2e-15, x clamped to [-1, 1]

/// The standard normal quantile: x with P(N < x) = p, 0 < p < 1; relative error < 1e-13 (refined by one
/// Halley step).
[[nodiscard]] double inverse_normal(double p);

} // namespace facetmill
