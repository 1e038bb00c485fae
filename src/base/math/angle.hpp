#pragma once
// The angle between vectors.

#include "base/math/portable_math.hpp"
#include "base/math/vec.hpp"

namespace facetmill {

/// In radians, from 0 to pi; 0 if a vector has no length. Unlike the arc cosine, the arc tangent keeps the
/// digits of small angles.
[[nodiscard]] inline double angle_between(const Vec3& a, const Vec3& b) {
    return arc_tangent(length(cross(a, b)), dot(a, b));
}

} // namespace facetmill
