#pragma once
// Products of very large or very small coordinates overflow or vanish. If a box is far from 1, coordinates
// are scaled by powers of two before summing, which rounds nothing, and the result is scaled back.

#include "mesh/mesh.hpp"

#include <array>

namespace facetmill {

/// p[i] -> p[i] * 2^powers[i].
struct PowerScale {
    std::array<int, 3> powers{};

    bool none() const { return powers == std::array<int, 3>{}; }
    Vec3 operator()(const Vec3& p) const;
    std::vector<Vec3> operator()(const std::vector<Vec3>& points) const;
    /// The mesh without its attributes. Coordinates far below the box's size may lose bits.
    Mesh operator()(const Mesh& mesh) const;
    PowerScale inverse() const { return {{-powers[0], -powers[1], -powers[2]}}; }
    /// The sum of the powers: what volumes are multiplied by.
    int volume() const { return powers[0] + powers[1] + powers[2]; }
};

/// Brings the longest side of the box to about 1, every axis alike: for lengths and areas. None while it is
/// between about 1e-30 and 1e30, where sums of fifth powers have room enough.
[[nodiscard]] PowerScale even_scale(const Box& box);

/// Brings each side of the box to about 1 by its own power, for volumes and moments; none while all are
/// within that range. A side of length zero stays.
[[nodiscard]] PowerScale axis_scale(const Box& box);

/// x / 2^power: infinite or zero when beyond the range of doubles.
[[nodiscard]] double unscaled(double x, int power);

/// length(v), also where the square of it would overflow or vanish.
[[nodiscard]] double scaled_length(const Vec3& v);
/// The same, scaled only where that is needed.
[[nodiscard]] inline double safe_length(const Vec3& v) {
    const double plain = length(v);
    return plain > 1e-140 && plain < 1e140 ? plain : scaled_length(v);
}

/// The length of the box's diagonal, also where the square of it would overflow or vanish; 0 when empty.
[[nodiscard]] double diagonal(const Box& box);

} // namespace facetmill
