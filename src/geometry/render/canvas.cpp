#include "geometry/render/canvas.hpp"

#include "base/parallel.hpp"

#include <algorithm>

namespace facetmill {

Canvas::Canvas(int pixels_wide, int pixels_high)
    : width(samples * pixels_wide), height(samples * pixels_high),
      depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -HUGE_VALF),
      colours(depth.size()) {}

CanvasTriangle::CanvasTriangle(const std::array<Vec3, 3>& corners) : p(corners) {
    area = (p[2].x - p[0].x) * (p[1].y - p[0].y) - (p[1].x - p[0].x) * (p[2].y - p[0].y);
}

Vec3 CanvasTriangle::towards_viewer() const {
    const Vec3 n = normalised(cross(p[1] - p[0], p[2] - p[0]));
    return n.z < 0 ? -n : n; // y points down, which turns the triangle over; the side seen is told by area
}

void draw(const CanvasTriangle& t, int first, int last, Canvas& canvas) {
    const auto [x0, x1] = std::minmax({t.p[0].x, t.p[1].x, t.p[2].x});
    const auto [y0, y1] = std::minmax({t.p[0].y, t.p[1].y, t.p[2].y});
    const auto within = [](double x, int low, int high) {
        return static_cast<int>(std::clamp<double>(x, low, high));
    };
    const int left = within(std::ceil(x0 - 0.5), 0, canvas.width);
    const int right = within(std::floor(x1 - 0.5), -1, canvas.width - 1);
    const int top = within(std::ceil(y0 - 0.5), first, last);
    const int bottom = within(std::floor(y1 - 0.5), first - 1, last - 1);
    const double behind = t.area > 0 ? 0 : 1e-3;
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 e = t.p[(i + 2) % 3] - t.p[(i + 1) % 3];
        lengths[i] = std::sqrt(e.x * e.x + e.y * e.y);
    }
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            double z = -behind, nearest_line = HUGE_VAL;
            Colour colour{};
            bool covered = true;
            for (std::size_t i = 0; i < 3 && covered; ++i) {
                const Vec3 &a = t.p[(i + 1) % 3], &b = t.p[(i + 2) % 3];
                const double w = ((b.y - a.y) * (x + 0.5 - a.x) - (b.x - a.x) * (y + 0.5 - a.y)) / t.area;
                covered = w >= 0;
                z += w * t.p[i].z;
                for (std::size_t c = 0; c < 3; ++c) colour[c] += static_cast<float>(w) * t.colours[i][c];
                if (t.lines[i]) nearest_line = std::min(nearest_line, w * std::abs(t.area) / lengths[i]);
            }
            if (!covered) continue;
            const float dim = nearest_line < 0.75 ? 0.45f : 1;
            canvas.put(x, y, z, {colour[0] * dim, colour[1] * dim, colour[2] * dim});
        }
}

void draw_dot(const Vec3& p, double side, const Colour& colour, Canvas& canvas) {
    const double half = side * Canvas::samples / 2;
    const auto first = [&](double x, int count) {
        return static_cast<int>(std::clamp<double>(std::ceil(x - half - 0.5), 0, count));
    };
    const auto last = [&](double x, int count) {
        return static_cast<int>(std::clamp<double>(std::ceil(x + half - 0.5), 0, count));
    };
    for (int y = first(p.y, canvas.height); y < last(p.y, canvas.height); ++y)
        for (int x = first(p.x, canvas.width); x < last(p.x, canvas.width); ++x)
            canvas.put(x, y, p.z, colour);
}

Picture developed(const Canvas& canvas, const std::optional<Colour>& ground) {
    constexpr int n = Canvas::samples;
    Picture picture;
    picture.width = canvas.width / n;
    picture.height = canvas.height / n;
    picture.rgba.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                        4);
    parallel_for(picture.rgba.size() / 4, [&](std::size_t pixel) {
        const std::size_t w = static_cast<std::size_t>(picture.width), x = pixel % w, y = pixel / w;
        Colour sum{};
        int covered = 0;
        for (std::size_t i = 0; i < n * n; ++i) {
            const std::size_t at = (y * n + i / n) * w * n + x * n + i % n;
            const bool there = canvas.depth[at] != -HUGE_VALF;
            if (!there && !ground) continue;
            ++covered;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += there ? canvas.colours[at][c] : (*ground)[c];
        }
        if (covered == 0) return;
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgba[4 * pixel + c] = static_cast<std::uint8_t>(std::floor(
                255 * std::sqrt(std::clamp(sum[c] / static_cast<float>(covered), 0.0f, 1.0f)) + 0.5f));
        picture.rgba[4 * pixel + 3] = static_cast<std::uint8_t>(255 * covered / (n * n));
    });
    return picture;
}

} // namespace facetmill
