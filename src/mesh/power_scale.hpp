#pragma once
// Scales coordinates, because products of very large or very small coordinates overflow or underflow. If a
// box is far from 1, coordinates are scaled by powers of two before summing, which rounds nothing, and the
// result is scaled back.

#include "mesh/mesh.hpp"

#include <array>

namespace facetmill {

/// Maps p[i] to p[i] * 2^powers[i].
struct PowerScale {
    std::array<int, 3> powers{};

    bool none() const { return powers == std::array<int, 3>{}; }
    Vec3 operator()(const Vec3& p) const;
    std::vector<Vec3> operator()(const std::vector<Vec3>& points) const;
    /// Scales the mesh, without its attributes. Coordinates far below the box's size may lose bits.
    Mesh operator()(const Mesh& mesh) const;
    PowerScale inverse() const { return {{-powers[0], -powers[1], -powers[2]}}; }
    /// The sum of the powers: volumes are multiplied by 2 to this power.
    int volume() const { return powers[0] + powers[1] + powers[2]; }
};

/// Scales all axes equally, so that the longest side of the box is about 1, for lengths and areas. No
/// scaling between about 1e-30 and 1e30, where sums of fifth powers fit.
[[nodiscard]] PowerScale even_scale(const Box& box);

/// Scales each side of the box separately to about 1, for volumes and moments. No scaling if all sides are
/// within the range of even_scale. A side of length zero stays.
[[nodiscard]] PowerScale axis_scale(const Box& box);

/// The value x / 2^power; infinite or zero beyond the range of doubles.
[[nodiscard]] double unscaled(double x, int power);

/// length(v), even if its square would overflow or underflow.
[[nodiscard]] double scaled_length(const Vec3& v);
/// Like scaled_length, but faster: scales only if necessary.
[[nodiscard]] inline double safe_length(const Vec3& v) {
    const double plain = length(v);
    return plain > 1e-140 && plain < 1e140 ? plain : scaled_length(v);
}

/// The length of the box's diagonal, even if its square would overflow or underflow; 0 if empty.
[[nodiscard]] double diagonal(const Box& box);

} // namespace facetmill
