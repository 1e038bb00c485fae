#pragma once
// What lies across from four triangles, within a distance of their planes.

#include "base/math/simd.hpp"

#include <array>

namespace facetmill {

/// Four at a time: x, y and z of four points or vectors.
using Float4x3 = std::array<Float4, 3>;

/// The points whose foot on the plane of a triangle is inside all its edges, for four triangles. Nothing has
/// unit length, so that no root is taken. In a frame in which the points that are asked about are within 1 of
/// the origin; triangles that reach beyond 2, and slivers, hold nothing.
struct TriangleSlabs {
    /// How far a sum of a few float32 numbers below 2 may be off.
    static constexpr float rounding = 0x1p-20F;

    /// corners: a, b and c; edges: from a to b and so on, rounded from exact differences. What is held is
    /// within the root of `square` of the triangle, give or take 4 times `rounding`.
    TriangleSlabs(const std::array<Float4x3, 3>& corners, const std::array<Float4x3, 3>& edges, float square);

    /// A bit for each triangle that the point lies across from.
    unsigned holding(float x, float y, float z) const {
        const auto along = [&](const Float4x3& v) { return v[0] * x + v[1] * y + v[2] * z; };
        const Float4 over = along(normal_) - offset_;
        Float4 beyond = along(out_[0]) - reach_[0];
        for (std::size_t i = 1; i < 3; ++i) beyond = greater(beyond, along(out_[i]) - reach_[i]);
        return bits_of((over * over <= square_) & (beyond <= Float4{}));
    }

  private:
    Float4x3 normal_;
    Float4 offset_, square_; ///< the height over the plane is (normal.x - offset) / |normal|; of squares,
                             ///< times the square of |normal|
    std::array<Float4x3, 3> out_;
    std::array<Float4, 3> reach_; ///< out[i].x is at most reach[i] inside
};

} // namespace facetmill
