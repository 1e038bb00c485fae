#pragma once
// Bounds on the distances between points and the triangles around a vertex. They bound distances from points
// to triangles, and from sample points on triangles to points. They are computed in float32, four at a time,
// so that most pairs need no exact test.

#include "base/math/simd.hpp"
#include "base/math/vec.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace facetmill::simplification {

class FanBounds {
  public:
    /// Sample points on a triangle, by the weights of b and c; the last is the shared vertex, listed twice.
    static constexpr std::size_t places = 6;
    static constexpr std::array<double, 8> weight_b{1.0 / 3, 0.5, 0.5, 1.0 / 6, 2.0 / 3, 1.0 / 6, 0, 0};
    static constexpr std::array<double, 8> weight_c{1.0 / 3, 0, 0.5, 1.0 / 6, 1.0 / 6, 2.0 / 3, 0, 0};

    /// centre: the vertex that the triangles share. reach: the largest coordinate distance of any point or
    /// triangle from it. near: the distance allowed between sample points and points.
    void begin(const Vec3& centre, double reach, double near) {
        centre_ = centre;
        triangles_.clear();
        unit_ = reach > 1e-100 && reach < 1e100 ? reach : 0;
        const double within = unit_ > 0 ? near / unit_ - double{error} : 0;
        near_square_ = within > 0 ? static_cast<float>(within * within * (1 - 1e-6)) : -1;
    }

    /// Adds a triangle of the shared vertex, b and c.
    void add(const Vec3& b, const Vec3& c) {
        Triangle& t = triangles_.emplace_back();
        if (!(unit_ > 0)) return;
        const Vec3 ab = (b - centre_) * (1 / unit_), ac = (c - centre_) * (1 / unit_), bc = ac - ab;
        for (std::size_t k = 0; k < 8; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                t.place[axis][k / 4][k % 4] =
                    static_cast<float>(ab[axis] * weight_b[k] + ac[axis] * weight_c[k]);
        const Vec3 n = cross(ab, ac);
        const double square = dot(n, n), size = dot(ab, ab) + dot(ac, ac);
        if (!(square > 1e-12 * size * size) || !(size < 1e20) || !(square > 1e-60)) return;
        t.sliver = false;
        const Vec3 normal = n * (1 / std::sqrt(square));
        const Vec3 out[] = {unit(cross(ab, normal)), unit(cross(bc, normal)), unit(cross(normal, ac))};
        set(t.normal, normal);
        for (std::size_t k = 0; k < 3; ++k) set(t.out[k], out[k]);
        t.reach = static_cast<float>(dot(out[1], ab));
    }

    /// Sets the one to four points that the following queries refer to.
    void look(std::span<const Vec3> points) {
        squares_.resize(triangles_.size());
        for (std::size_t axis = 0; axis < 3; ++axis) at_[axis] = Float4{};
        for (std::size_t i = 0; unit_ > 0 && i < points.size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                at_[axis][i] = static_cast<float>((points[i][axis] - centre_[axis]) / unit_);
        least_ = over_ = all(HUGE_VALF);
        nearest_ = Int4{} - 1;
        for (std::size_t k = 0; k < triangles_.size(); ++k) compare(triangles_[k], static_cast<int>(k));
    }

    /// A lower bound of the squared distance from a point to a triangle; 0 for slivers.
    double square(std::size_t triangle, std::size_t point) const {
        return double{squares_[triangle][point]} * unit_ * unit_;
    }
    /// The triangle with the least lower bound; -1 if there is no triangle or the point is not finite.
    std::int32_t nearest(std::size_t point) const { return nearest_[point]; }
    /// An upper bound of the squared distance to the nearest triangle. It is infinite when the nearest point
    /// of the triangle may be on its edge.
    double most(std::size_t point) const { return double{over_[point]} * unit_ * unit_; }

    /// Marks the sample points of a triangle that are near a point.
    void note_near(std::size_t triangle, std::size_t point) {
        Triangle& t = triangles_[triangle];
        if (t.near == 255) return;
        for (std::size_t half = 0; half < 2; ++half) {
            Float4 square{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Float4 off = t.place[axis][half] - at_[axis][point];
                square += off * off;
            }
            t.near |= bits_of(square <= all(near_square_)) << 4 * half;
        }
    }
    /// The marked sample points, as a bit mask.
    unsigned near(std::size_t triangle) const { return triangles_[triangle].near; }

  private:
    /// Exceeds the rounding error of a few float32 operations whose relevant operands are below 2.
    static constexpr float error = 0x1p-20F;

    struct Triangle {
        float normal[3] = {}, out[3][3] = {}, reach = 0;
        bool sliver = true;
        unsigned near = 0;
        Float4 place[3][2] = {};
    };

    static Float4 all(float x) { return Float4{} + x; }
    static Vec3 unit(const Vec3& v) { return v * (1 / std::sqrt(dot(v, v))); }
    static void set(float (&to)[3], const Vec3& v) {
        for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = static_cast<float>(v[axis]);
    }
    Float4 along(const float (&v)[3]) const { return at_[0] * v[0] + at_[1] * v[1] + at_[2] * v[2]; }

    void compare(const Triangle& t, int number) {
        Float4 square{}, over = all(HUGE_VALF);
        if (!t.sliver) {
            const Float4 up = along(t.normal), height = greater(up, -up);
            const Float4 beyond =
                greater(greater(along(t.out[0]), along(t.out[2])), along(t.out[1]) - t.reach);
            const Float4 above = greater(height - error, Float4{}), aside = greater(beyond - error, Float4{});
            square = (above * above + aside * aside) * (1 - 1e-6F);
            over = beyond < all(-error) ? (height + error) * (height + error) * (1 + 1e-6F) : over;
        }
        squares_[static_cast<std::size_t>(number)] = square;
        const Int4 nearer = square < least_;
        least_ = nearer ? square : least_;
        over_ = nearer ? over : over_;
        nearest_ = nearer ? Int4{} + number : nearest_;
    }

    Vec3 centre_;
    double unit_ = 0; ///< scale of the frame in which float32 is precise enough; 0 if there is none
    float near_square_ = -1;
    std::vector<Triangle> triangles_;
    std::vector<Float4> squares_; ///< [triangles] squared distances of the points
    std::array<Float4, 3> at_{};  ///< the points, by axis
    Float4 least_{}, over_{};
    Int4 nearest_{};
};

} // namespace facetmill::simplification
