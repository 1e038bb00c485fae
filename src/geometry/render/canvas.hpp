#pragma once
// Triangles and dots on a z-buffer of samples that know what is seen in them.

#include "geometry/render/render.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

using Colour = std::array<float, 3>; ///< linear

/// What has been drawn so far. x right, y down, z towards the viewer, all in samples.
struct Canvas {
    static constexpr int samples = 2; ///< a side of each pixel

    int width, height; ///< samples
    std::vector<float> depth;
    std::vector<std::uint32_t> seen; ///< the number of what is seen; none: nothing

    Canvas(int pixels_wide, int pixels_high)
        : width(samples * pixels_wide), height(samples * pixels_high),
          depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -HUGE_VALF),
          seen(depth.size(), none) {}
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    void put(int x, int y, double z, std::uint32_t number) {
        const std::size_t i = at(x, y);
        if (!(static_cast<float>(z) > depth[i])) return;
        depth[i] = static_cast<float>(z);
        seen[i] = number;
    }
};

/// An edge's line through the canvas; the two triangles at an edge get the same numbers but for their sign,
/// so that no sample between them is missed.
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

/// A triangle on the canvas, seen anticlockwise or not.
struct CanvasTriangle {
    std::array<Vec3, 3> p;
    std::array<EdgeLine, 3> edges; ///< opposite to each corner
    double area = 0;               ///< twice, positive when it is seen anticlockwise

    explicit CanvasTriangle(const std::array<Vec3, 3>& corners) : p(corners) {
        area = (p[2].x - p[0].x) * (p[1].y - p[0].y) - (p[1].x - p[0].x) * (p[2].y - p[0].y);
        for (std::size_t i = 0; i < 3; ++i) edges[i] = EdgeLine(p[(i + 1) % 3], p[(i + 2) % 3]);
    }
    bool drawn() const { return area != 0 && is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]); }
    /// The weights of the corners at a place of the canvas' plane; they sum to one.
    Vec3 weights(double x, double y) const {
        const double b = edges[1].of(x, y) / area, c = edges[2].of(x, y) / area;
        return {1 - b - c, b, c};
    }
    /// The distance to the nearest of the edges that are marked, in samples.
    double nearest_edge(double x, double y, const std::array<bool, 3>& marked) const {
        double nearest = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i)
            if (marked[i]) nearest = std::min(nearest, std::abs(edges[i].of(x, y)) / edges[i].length());
        return nearest;
    }
};

/// Calls visit(x, y, depth) for the samples of the triangle in the rows [first, last). Where a back and a
/// front are at one place the front is seen: backs lie a thousandth of a sample behind. front: the outer side
/// is seen.
template <class Visit>
void for_each_sample(const CanvasTriangle& t, bool front, int first, int last, int width, Visit&& visit) {
    const auto [x0, x1] = std::minmax({t.p[0].x, t.p[1].x, t.p[2].x});
    const auto [y0, y1] = std::minmax({t.p[0].y, t.p[1].y, t.p[2].y});
    const auto within = [](double x, int low, int high) {
        return static_cast<int>(std::clamp<double>(x, low, high));
    };
    const int left = within(std::ceil(x0 - 0.5), 0, width);
    const int right = within(std::floor(x1 - 0.5), -1, width - 1);
    const int top = within(std::ceil(y0 - 0.5), first, last);
    const int bottom = within(std::floor(y1 - 0.5), first - 1, last - 1);
    if (left > right || top > bottom) return;
    const double behind = front ? 0 : 1e-3, side = t.area > 0 ? 1 : -1, share = 1 / t.area;
    const EdgeLine &e = t.edges[0], &f = t.edges[1], &g = t.edges[2];
    for (int y = top; y <= bottom; ++y) {
        const double py = y + 0.5, ey = e.dx * (py - e.y), fy = f.dx * (py - f.y), gy = g.dx * (py - g.y);
        for (int x = left; x <= right; ++x) {
            const double px = x + 0.5; // as EdgeLine::of
            const double a = e.sign * (e.dy * (px - e.x) - ey);
            if (!(a * side >= 0)) continue;
            const double b = f.sign * (f.dy * (px - f.x) - fy);
            if (!(b * side >= 0)) continue;
            const double c = g.sign * (g.dy * (px - g.x) - gy);
            if (!(c * side >= 0)) continue;
            visit(x, y, (a * t.p[0].z + b * t.p[1].z + c * t.p[2].z) * share - behind);
        }
    }
}

/// Draws a square of side pixels around p, cut off at the canvas' borders.
inline void draw_dot(const Vec3& p, double side, std::uint32_t number, Canvas& canvas) {
    const double half = side * Canvas::samples / 2;
    const auto bound = [&](double x, int count) {
        return static_cast<int>(std::clamp<double>(std::ceil(x - 0.5), 0, count));
    };
    const int left = bound(p.x - half, canvas.width), right = bound(p.x + half, canvas.width);
    for (int y = bound(p.y - half, canvas.height); y < bound(p.y + half, canvas.height); ++y)
        for (int x = left; x < right; ++x) canvas.put(x, y, p.z, number);
}

} // namespace facetmill
