#pragma once
// Triangles and dots on a z-buffer of samples, and the picture that comes out.

#include "geometry/render/render.hpp"

#include <array>

namespace facetmill {

using Colour = std::array<float, 3>; ///< linear

/// What has been drawn so far. x right, y down, z towards the viewer, all in samples.
struct Canvas {
    static constexpr int samples = 2; ///< a side of each pixel

    int width, height; ///< samples
    std::vector<float> depth;
    std::vector<Colour> colours;

    Canvas(int pixels_wide, int pixels_high);
    void put(int x, int y, double z, const Colour& colour) {
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        if (!(static_cast<float>(z) > depth[at])) return;
        depth[at] = static_cast<float>(z);
        colours[at] = colour;
    }
};

/// A triangle on the canvas, seen anticlockwise or not.
struct CanvasTriangle {
    std::array<Vec3, 3> p;
    std::array<Colour, 3> colours{}; ///< at the corners
    std::array<bool, 3> lines{};     ///< which edges are drawn: that opposite to each corner
    double area = 0;                 ///< twice, positive when the front is seen

    explicit CanvasTriangle(const std::array<Vec3, 3>& corners);
    bool drawn() const { return area != 0 && is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]); }
    /// The unit normal towards the viewer; y points down.
    Vec3 towards_viewer() const;
};

/// Draws the rows [first, last) of the triangle. Where a back and a front are at one place the front is seen:
/// backs lie a thousandth of a sample behind.
void draw(const CanvasTriangle& t, int first, int last, Canvas& canvas);

/// Draws a square of side pixels around p, cut off at the canvas' borders.
void draw_dot(const Vec3& p, double side, const Colour& colour, Canvas& canvas);

/// The means of each pixel's samples. The square root stands for sRGB's curve: near enough for a picture.
Picture developed(const Canvas& canvas, const std::optional<Colour>& ground);

} // namespace facetmill
