#pragma once
// Curves of a DXF: non-uniform rational B-splines in the plane.

#include "geometry/polygon/polygon.hpp"

#include <vector>

namespace facetmill::io {

struct Nurbs {
    static constexpr int highest_degree = 32;

    int degree = 3;
    std::vector<double> knots, weights; ///< without weights, all are 1
    std::vector<Vec2> points;

    /// The counts fit, knots do not descend, and weights are positive.
    bool is_valid() const;
};

/// Points of the curve from its first to its last. Neighbouring segments turn by at most 5 degrees, except
/// at corners of the curve, and after seven halvings. At most so many points, and a few more. After C. de
/// Boor, "On calculating with B-splines" (1972).
[[nodiscard]] std::vector<Vec2> flattened(const Nurbs& curve, std::size_t most_points);

} // namespace facetmill::io
