#pragma once
// Tests whether points project into four triangles, within a distance of their planes.

#include "base/math/simd.hpp"

#include <array>

namespace facetmill {

/// The x, y and z of four points or vectors.
using Float4x3 = std::array<Float4, 3>;

/// For four triangles: the slabs of points whose foot on the triangle's plane is inside all edges. Vectors
/// are not normalised, to avoid square roots. In the frame, queried points must be within 1 of the origin.
/// Triangles that extend beyond 2, and slivers, contain nothing.
struct TriangleSlabs {
    /// The error of a sum of a few float32 numbers below 2.
    static constexpr float rounding = 0x1p-20F;

    /// corners: a, b and c; edges: from a to b and so on, rounded from exact differences. Contained points
    /// are within the square root of `square` of the triangle, plus or minus 4 times `rounding`.
    TriangleSlabs(const std::array<Float4x3, 3>& corners, const std::array<Float4x3, 3>& edges, float square);

    /// A bit for each triangle into which the point projects.
    unsigned holding(float x, float y, float z) const {
        const auto along = [&](const Float4x3& v) { return v[0] * x + v[1] * y + v[2] * z; };
        const Float4 over = along(normal_) - offset_;
        Float4 beyond = along(out_[0]) - reach_[0];
        for (std::size_t i = 1; i < 3; ++i) beyond = greater(beyond, along(out_[i]) - reach_[i]);
        return bits_of((over * over <= square_) & (beyond <= Float4{}));
    }

  private:
    Float4x3 normal_;
    Float4 offset_, square_; ///< the height above the plane is (normal.x - offset) / |normal|; square_ is
                             ///< times |normal|^2
    std::array<Float4x3, 3> out_;
    std::array<Float4, 3> reach_; ///< out[i].x is at most reach[i] for points inside
};

} // namespace facetmill
