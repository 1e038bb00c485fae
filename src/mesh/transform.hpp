#pragma once
// Functions of affine maps: the inverse, and the growth of lengths, to convert world lengths to a part's own
// space.

#include "base/math/portable_math.hpp"
#include "base/math/vec.hpp"

#include <optional>

namespace facetmill {

/// The inverse of an affine map; none if it is singular.
[[nodiscard]] std::optional<Transform> inverse(const Transform& t);

/// Transforms a normal direction: the cofactors times it.
[[nodiscard]] inline Vec3 moved_normal(const Transform& t, const Vec3& n) {
    const Vec3 x{t.m[0][0], t.m[0][1], t.m[0][2]}, y{t.m[1][0], t.m[1][1], t.m[1][2]},
        z{t.m[2][0], t.m[2][1], t.m[2][2]};
    return {dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n)};
}

/// The vector rotated about a unit axis by an angle in radians, anticlockwise seen against the axis. After
/// O. Rodrigues, "Des lois geometriques qui regissent les deplacements d'un systeme solide dans l'espace"
/// (1840).
[[nodiscard]] inline Vec3 rotated(const Vec3& v, const Vec3& axis, double angle) {
    const double c = cosine(angle), s = sine(angle);
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

/// The cube root of the growth of volumes: the growth of lengths under a rotation and a uniform scale, and
/// its geometric mean under other transforms. 1 for a transform that flattens.
[[nodiscard]] inline double mean_stretch(const Transform& t) {
    const double volume = std::abs(t.determinant());
    return volume > 0 && std::isfinite(volume) && volume != 1 ? exponential(logarithm(volume) / 3) : 1;
}

/// True if the transform only rotates, mirrors, moves and scales alike along all axes.
[[nodiscard]] inline bool is_similarity(const Transform& t) {
    const Vec3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
    const double xx = dot(x, x), slack = 1e-9 * (xx + dot(y, y) + dot(z, z)); // rounding of a product
    return std::abs(dot(y, y) - xx) < slack && std::abs(dot(z, z) - xx) < slack &&
           std::abs(dot(x, y)) < slack && std::abs(dot(y, z)) < slack && std::abs(dot(z, x)) < slack;
}

/// The largest growth of any length: exact for similarities, otherwise at most sqrt(3) times too large. 1
/// for a transform that flattens to a point.
[[nodiscard]] inline double greatest_stretch(const Transform& t) {
    const Vec3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
    const double xx = dot(x, x), most = std::sqrt(is_similarity(t) ? xx : xx + dot(y, y) + dot(z, z));
    return most > 0 ? most : 1;
}

/// The box around the corners of another box after a transform.
[[nodiscard]] inline Box box_of_corners(const Box& box, const Transform& t) {
    Box out;
    for (int corner = 0; corner < 8 && !box.empty(); ++corner)
        out.add(t.point({(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                         (corner & 4 ? box.max : box.min).z}));
    return out;
}

} // namespace facetmill
