#pragma once
// Draws triangles and dots on a z-buffer of samples. Each sample stores the number of the visible triangle
// or dot.

#include "base/math/whole_number.hpp"
#include "geometry/render/render.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <utility>

namespace facetmill {

using Colour = std::array<float, 3>; ///< linear

/// The drawing so far. x right, y down, z towards the viewer, all in samples. Threads may draw at the same
/// time, in any order: each sample shows the nearest element, with the lowest number if depths are equal.
struct Canvas {
    static constexpr int samples = 2; ///< samples along a side of each pixel

    int width, height; ///< in samples

    Canvas(int pixels_wide, int pixels_high)
        : width(samples * pixels_wide), height(samples * pixels_high),
          nearest_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                   packed(-HUGE_VALF, none)) {}
    std::size_t size() const { return nearest_.size(); }
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    void put(int x, int y, double z, std::uint32_t number) {
        const auto depth = static_cast<float>(z);
        if (!(depth > -HUGE_VALF)) return; // also rejects NaN
        const std::uint64_t mine = packed(depth, number);
        const std::atomic_ref<std::uint64_t> sample(nearest_[at(x, y)]);
        std::uint64_t there = sample.load(std::memory_order_relaxed);
        while (mine > there && !sample.compare_exchange_weak(there, mine, std::memory_order_relaxed)) {
        }
    }
    /// Whether anything drawn at sample i at this depth or deeper would be hidden.
    bool hides(std::size_t i, float depth) {
        const std::atomic_ref<std::uint64_t> sample(nearest_[i]);
        return sample.load(std::memory_order_relaxed) >= packed(depth, 0);
    }
    /// The depth at sample i; -infinity if the sample is empty.
    float depth(std::size_t i) const {
        const auto bits = static_cast<std::uint32_t>(nearest_[i] >> 32);
        return std::bit_cast<float>(bits & sign ? bits ^ sign : ~bits);
    }
    /// The number of the visible element at sample i; none if the sample is empty.
    std::uint32_t seen(std::size_t i) const { return ~static_cast<std::uint32_t>(nearest_[i]); }

  private:
    static constexpr std::uint32_t sign = 0x80000000;
    /// Maps depth and number to an ordered integer: nearer is greater, and at equal depth the lower number
    /// is greater.
    static std::uint64_t packed(float depth, std::uint32_t number) {
        const auto bits = std::bit_cast<std::uint32_t>(depth + 0.0f); // avoids -0
        return std::uint64_t{bits & sign ? ~bits : bits | sign} << 32 | (~number & 0xffffffff);
    }

    std::vector<std::uint64_t> nearest_;
};

/// A range of samples whose centres are in a box. Both bounds are inclusive.
struct SampleBox {
    int left, right, top, bottom;

    bool empty() const { return left > right || top > bottom; }
    std::size_t size() const {
        return static_cast<std::size_t>(right - left + 1) * static_cast<std::size_t>(bottom - top + 1);
    }
};

/// The first sample whose centre is at or after x, and the last sample whose centre is at or before x. Both
/// are clamped to [low, high]. NaN counts as low.
[[nodiscard]] inline double within(double x, int low, int high) { // NaN is outside of no range
    return x > low ? (x < high ? x : high) : low;
}
[[nodiscard]] inline int first_sample(double x, int low,
                                      int high) { // rounding by conversion is faster than the library's
    const double inside = within(x - 0.5, low, high);
    const int whole = static_cast<int>(inside);
    return whole < inside ? whole + 1 : whole;
}
[[nodiscard]] inline int last_sample(double x, int low, int high) {
    const double inside = within(x - 0.5, low, high);
    const int whole = static_cast<int>(inside);
    return whole > inside ? whole - 1 : whole;
}

/// The samples in the bounding box of a triangle, in the rows [first, last) of a canvas of this width. If
/// corners are not finite, the result is arbitrary but in range.
[[nodiscard]] inline SampleBox samples_around(const Vec3& a, const Vec3& b, const Vec3& c, int first,
                                              int last, int width) {
    const auto lowest = [](double x, double y, double z) { return std::min(std::min(x, y), z); };
    const auto highest = [](double x, double y, double z) { return std::max(std::max(x, y), z); };
    return {first_sample(lowest(a.x, b.x, c.x), 0, width), last_sample(highest(a.x, b.x, c.x), -1, width - 1),
            first_sample(lowest(a.y, b.y, c.y), first, last),
            last_sample(highest(a.y, b.y, c.y), first - 1, last - 1)};
}

/// The bounding box of single points, in four small numbers. Most triangles of a large mesh contain no
/// sample, and these numbers show this before the points are read. Right and bottom are negated, so that the
/// minimum of each number over several points gives their common box.
class SamplesAt {
  public:
    SamplesAt() = default;
    /// The canvas must have at most 32,767 samples a side.
    SamplesAt(const Vec3& p, const Canvas& canvas)
        : bounds_{short_of(first_sample(p.x, 0, canvas.width)), short_of(first_sample(p.y, 0, canvas.height)),
                  short_of(-last_sample(p.x, -1, canvas.width - 1)),
                  short_of(-last_sample(p.y, -1, canvas.height - 1))} {}

    /// Like samples_around for three points, on the whole canvas.
    static SampleBox around(const SamplesAt& a, const SamplesAt& b, const SamplesAt& c) {
        const Bounds least = lesser(lesser(a.bounds_, b.bounds_), c.bounds_);
        return {least[0], -least[2], least[1], -least[3]};
    }

  private:
    using Bounds = std::int16_t __attribute__((vector_size(8)));
    static std::int16_t short_of(int x) { return static_cast<std::int16_t>(x); }
    static Bounds lesser(const Bounds& a, const Bounds& b) { return a < b ? a : b; }

    Bounds bounds_{};
};

/// The line of an edge through the canvas. The two triangles at an edge get the same numbers with opposite
/// signs, so that no sample between them is missed.
struct EdgeLine {
    double x = 0, y = 0, dx = 0, dy = 0, sign = 1;

    EdgeLine() = default;
    EdgeLine(const Vec3& a, const Vec3& b) {
        const bool swapped = a.x != b.x ? b.x < a.x : b.y < a.y;
        const Vec3 &from = swapped ? b : a, &to = swapped ? a : b;
        x = from.x;
        y = from.y;
        dx = to.x - from.x;
        dy = to.y - from.y;
        sign = swapped ? -1 : 1;
    }
    /// Twice the area of the triangle with (px, py): positive on one side.
    double of(double px, double py) const { return sign * (dy * (px - x) - dx * (py - y)); }
    double length() const { return std::sqrt(dx * dx + dy * dy); }
};

/// Twice the area of a triangle on the canvas; positive if it appears anticlockwise.
[[nodiscard]] inline double twice_area(const std::array<Vec3, 3>& p) {
    return (p[2].x - p[0].x) * (p[1].y - p[0].y) - (p[1].x - p[0].x) * (p[2].y - p[0].y);
}

/// The smallest depth of a triangle; no sample of the triangle lies before it.
[[nodiscard]] inline double nearest_depth(const std::array<Vec3, 3>& p) {
    return std::max(std::max(p[0].z, p[1].z), p[2].z);
}

/// A triangle on the canvas, in either orientation.
struct CanvasTriangle {
    std::array<Vec3, 3> p;
    std::array<EdgeLine, 3> edges; ///< edges opposite to each corner
    double area;                   ///< twice the area; positive if it appears anticlockwise

    explicit CanvasTriangle(const std::array<Vec3, 3>& corners) : p(corners), area(twice_area(p)) {
        for (std::size_t i = 0; i < 3; ++i) edges[i] = EdgeLine(p[(i + 1) % 3], p[(i + 2) % 3]);
    }
    bool drawn() const { return area != 0 && is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]); }
    /// The weights of the corners at a canvas position; they sum to one.
    Vec3 weights(double x, double y) const {
        const double b = edges[1].of(x, y) / area, c = edges[2].of(x, y) / area;
        return {1 - b - c, b, c};
    }
    /// The distance to the nearest marked edge, in samples.
    double nearest_edge(double x, double y, const std::array<bool, 3>& marked) const {
        double nearest = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i)
            if (marked[i]) nearest = std::min(nearest, std::abs(edges[i].of(x, y)) / edges[i].length());
        return nearest;
    }
};

/// The range of samples in a row that may lie in the triangle, with a margin of one sample on either side.
/// The caller tests each sample. py: the row's y.
[[nodiscard]] inline std::pair<int, int> row_between(const CanvasTriangle& t, double py,
                                                     const SampleBox& box) {
    constexpr double far = 0x1p40; // beyond this, rounding may exceed a sample
    double low = box.left, high = box.right;
    for (const EdgeLine& e : t.edges) {
        const double inside =
            t.area > 0 ? e.sign * e.dy : -e.sign * e.dy; // above 0: the inside is to the right
        const double at = e.x + e.dx * (py - e.y) / e.dy - 0.5;
        if (inside == 0 || !(std::abs(e.x) < far && std::abs(at) < far)) continue;
        if (inside > 0)
            low = std::max(low, at - 1);
        else
            high = std::min(high, at + 1);
    }
    return {static_cast<int>(std::min(std::ceil(low), box.right + 1.0)),
            static_cast<int>(std::max(std::floor(high), box.left - 1.0))};
}

/// Calls visit(x, y, depth) for the samples of the triangle in the box from samples_around. If a back and a
/// front coincide, the front is visible, because backs are drawn a thousandth of a sample deeper. front: the
/// outer side is visible.
template <class Visit>
void for_each_sample(const CanvasTriangle& t, bool front, const SampleBox& box, Visit&& visit) {
    const double behind = front ? 0 : 1e-3, side = t.area > 0 ? 1 : -1, share = 1 / t.area;
    const double nearest = nearest_depth(t.p); // on a sliver, rounding would put samples in front of it
    const EdgeLine &e = t.edges[0], &f = t.edges[1], &g = t.edges[2];
    const bool wide = box.right - box.left > 16; // few samples of a sliver's box are inside the sliver
    for (int y = box.top; y <= box.bottom; ++y) {
        const double py = y + 0.5, ey = e.dx * (py - e.y), fy = f.dx * (py - f.y), gy = g.dx * (py - g.y);
        const auto [left, right] = wide ? row_between(t, py, box) : std::pair(box.left, box.right);
        for (int x = left; x <= right; ++x) {
            const double px = x + 0.5; // centre of the sample, as in EdgeLine::of
            const double a = e.sign * (e.dy * (px - e.x) - ey);
            if (!(a * side >= 0)) continue;
            const double b = f.sign * (f.dy * (px - f.x) - fy);
            if (!(b * side >= 0)) continue;
            const double c = g.sign * (g.dy * (px - g.x) - gy);
            if (!(c * side >= 0)) continue;
            visit(x, y, std::min((a * t.p[0].z + b * t.p[1].z + c * t.p[2].z) * share, nearest) - behind);
        }
    }
}

/// Draws a square with sides of `side` pixels around p, clipped at the canvas' borders.
inline void draw_dot(const Vec3& p, double side, std::uint32_t number, Canvas& canvas) {
    const double half = side * Canvas::samples / 2;
    const auto bound = [&](double x, int count) {
        return std::clamp(whole_number<int>(std::ceil(x - 0.5)), 0, count);
    };
    const int left = bound(p.x - half, canvas.width), right = bound(p.x + half, canvas.width);
    for (int y = bound(p.y - half, canvas.height); y < bound(p.y + half, canvas.height); ++y)
        for (int x = left; x < right; ++x) canvas.put(x, y, p.z, number);
}

} // namespace facetmill
