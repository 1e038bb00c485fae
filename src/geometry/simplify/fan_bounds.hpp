#pragma once
// How far points are at least from the triangles around a vertex: in float32, four points at a time, so that
// most pairs need no more.

#include "base/simd.hpp"
#include "base/vec.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace facetmill::simplification {

class FanBounds {
  public:
    /// The points from now on, and the vertex that the triangles share.
    void begin(const Vec3& centre, std::span<const Vec3> points) {
        centre_ = centre;
        fours_ = (points.size() + 3) / 4;
        places_.assign(3 * fours_, Float4{});
        squares_.clear();
        double reach = 0;
        for (const Vec3& p : points) {
            const Vec3 at = p - centre;
            reach = std::max({reach, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        }
        unit_ = reach > 1e-100 && reach < 1e100 ? reach : 0;
        for (std::size_t i = 0; unit_ > 0 && i < points.size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                places_[3 * (i / 4) + axis][i % 4] =
                    static_cast<float>((points[i][axis] - centre[axis]) / unit_);
    }

    /// The next triangle: the shared vertex, b and c.
    void add(const Vec3& b, const Vec3& c) {
        squares_.resize(squares_.size() + fours_, Float4{});
        const Vec3 ab = (b - centre_) * (1 / unit_), ac = (c - centre_) * (1 / unit_), bc = ac - ab;
        const Vec3 n = cross(ab, ac);
        const double square = dot(n, n), size = dot(ab, ab) + dot(ac, ac);
        if (!(unit_ > 0) || !(square > 1e-12 * size * size) || !(size < 1e20) || !(square > 1e-60)) return;
        const Vec3 normal = n * (1 / std::sqrt(square));
        const Vec3 out[] = {unit(cross(ab, normal)), unit(cross(bc, normal)), unit(cross(normal, ac))};
        const double reach[] = {0, dot(out[1], ab), 0};
        Float4* const squares = &squares_[squares_.size() - fours_];
        for (std::size_t i = 0; i < fours_; ++i) {
            const Float4 up = along(i, normal);
            const Float4 over = greater(greater(up, -up) - error, Float4{});
            Float4 aside{};
            for (std::size_t k = 0; k < 3; ++k)
                aside = greater(aside, along(i, out[k]) - static_cast<float>(reach[k]) - error);
            squares[i] = (over * over + aside * aside) * (1 - 1e-6F);
        }
    }

    /// The squared distance of a point to a triangle is not below this; 0 for slivers.
    double square(std::size_t triangle, std::size_t point) const {
        return double{squares_[triangle * fours_ + point / 4][point % 4]} * unit_ * unit_;
    }

  private:
    /// More than the rounding of a few float32 numbers of which those that count are below 2.
    static constexpr float error = 0x1p-20F;

    static Vec3 unit(const Vec3& v) { return v * (1 / std::sqrt(dot(v, v))); }
    Float4 along(std::size_t four, const Vec3& v) const {
        return places_[3 * four] * static_cast<float>(v.x) + places_[3 * four + 1] * static_cast<float>(v.y) +
               places_[3 * four + 2] * static_cast<float>(v.z);
    }

    Vec3 centre_;
    double unit_ = 0; ///< of the frame in which float32 is enough; 0: there is none
    std::size_t fours_ = 0;
    std::vector<Float4> places_;  ///< x, y and z of four points each
    std::vector<Float4> squares_; ///< [triangles][fours]
};

} // namespace facetmill::simplification
