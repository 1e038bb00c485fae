#include "geometry/render/occlusion.hpp"

#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

namespace {

constexpr std::size_t looks_around = 16, pattern = 4;

/// The position of the nearest sample of each pixel, along the canvas' axes.
struct Places {
    int width = 0, height = 0; ///< in pixels
    std::vector<std::array<float, 3>> place;
    std::vector<std::uint32_t> seen;

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

Places places_on(const Canvas& canvas, const View& view) {
    constexpr int n = Canvas::samples;
    Places places{canvas.width / n, canvas.height / n, {}, {}};
    const auto width = static_cast<std::size_t>(places.width);
    places.place.resize(width * static_cast<std::size_t>(places.height));
    places.seen.assign(places.place.size(), none);
    parallel_for(places.place.size(), [&](std::size_t pixel) {
        const int x = static_cast<int>(pixel % width) * n, y = static_cast<int>(pixel / width) * n;
        int best_x = x, best_y = y;
        for (int i = 1; i < n * n; ++i)
            if (canvas.depth(canvas.at(x + i % n, y + i / n)) > canvas.depth(canvas.at(best_x, best_y))) {
                best_x = x + i % n;
                best_y = y + i / n;
            }
        const std::size_t i = canvas.at(best_x, best_y);
        places.seen[pixel] = canvas.seen(i);
        if (canvas.seen(i) == none) return;
        const Vec3 p = view.place({best_x + 0.5, best_y + 0.5, static_cast<double>(canvas.depth(i))});
        for (std::size_t c = 0; c < 3; ++c) places.place[pixel][c] = static_cast<float>(p[c]);
    });
    return places;
}

/// Offsets in pixels: a spiral of looks_around positions, in pattern x pattern rotations.
using Spiral = std::array<std::array<int, 2>, looks_around>;
std::array<Spiral, pattern * pattern> spirals(double radius) {
    // The rotation of each pixel of the pattern, chosen so that neighbours differ much.
    static constexpr std::array<int, pattern * pattern> order{0, 8,  2, 10, 12, 4, 14, 6,
                                                              3, 11, 1, 9,  15, 7, 13, 5};
    constexpr double turns = 7; // does not divide the number of positions
    std::array<Spiral, pattern * pattern> all{};
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < looks_around; ++k) {
            const double share = (static_cast<double>(k) + 0.5) / looks_around;
            const double angle = 2 * pi * (share * turns + order[i] / 16.0);
            const double far = std::max(1.0, share * radius / Canvas::samples);
            all[i][k] = {static_cast<int>(std::floor(far * cosine(angle) + 0.5)),
                         static_cast<int>(std::floor(far * sine(angle) + 0.5))};
        }
    return all;
}

/// The share of p's sky that q hides.
float hidden_by(const std::array<float, 3>& p, const std::array<float, 3>& normal,
                const std::array<float, 3>& q, float radius) {
    const std::array<float, 3> v{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    const float vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2], rr = radius * radius;
    const float above = v[0] * normal[0] + v[1] * normal[1] + v[2] * normal[2];
    // Two samples of slack, because depths belong to samples and not to pixel centres.
    const float slack = 1.0f + 0.02f * radius;
    if (above <= slack || vv >= rr) return 0;
    const float f = 1 - vv / rr;
    return f * f * f * (above - slack) / std::sqrt(vv);
}

float open_at(const Places& places, const Spiral& spiral, std::size_t pixel,
              const std::array<float, 3>& normal, float radius) {
    const auto width = static_cast<std::size_t>(places.width);
    const auto& p = places.place[pixel];
    float hidden = 0;
    for (const auto& [dx, dy] : spiral) {
        const int qx = static_cast<int>(pixel % width) + dx, qy = static_cast<int>(pixel / width) + dy;
        if (qx < 0 || qy < 0 || qx >= places.width || qy >= places.height) continue;
        const std::size_t q = places.at(qx, qy);
        if (places.seen[q] != none) hidden += hidden_by(p, normal, places.place[q], radius);
    }
    constexpr float strength = 6.0f / looks_around;
    return std::max(0.15f, 1 - strength * hidden);
}

/// The pixels that a mean covers, and the pixels that get a mean.
struct Smoothing {
    int every = 1;      ///< use only every n-th column and row
    int reach = 2;      ///< the window in pixels, from -reach to reach - 1
    bool of_all = true; ///< compute it for all pixels, otherwise only for that grid
};

/// The mean over the pixels of similar depth around each pixel; the pixel's own value if none are known.
template <class OpenAt>
std::vector<float> smoothed(const Places& places, const std::vector<float>& open, float radius,
                            const Smoothing& s, OpenAt&& open_at) {
    std::vector<float> out(open.size(), 1);
    const auto width = static_cast<std::size_t>(places.width);
    const auto first = [&](int at) { return (std::max(0, at - s.reach) + s.every - 1) / s.every * s.every; };
    parallel_for(open.size(), [&](std::size_t pixel) {
        if (places.seen[pixel] == none) return;
        const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
        if (!s.of_all && (x % s.every != 0 || y % s.every != 0)) return;
        float sum = 0, count = 0;
        for (int qy = first(y); qy < std::min(places.height, y + s.reach); qy += s.every)
            for (int qx = first(x); qx < std::min(places.width, x + s.reach); qx += s.every) {
                const std::size_t q = places.at(qx, qy);
                if (places.seen[q] == none ||
                    std::abs(places.place[q][2] - places.place[pixel][2]) > 0.25f * radius)
                    continue;
                sum += open[q];
                count += 1;
            }
        out[pixel] = count > 0 ? sum / count : open_at(pixel);
    });
    return out;
}

} // namespace

std::vector<float> open_sky(const Canvas& canvas, const SceneDrawing& drawing, const Shader& shader,
                            const View& view, double radius, bool coarse) {
    const Places places = places_on(canvas, view);
    const auto all = spirals(radius);
    const auto width = static_cast<std::size_t>(places.width), every = coarse ? std::size_t{2} : 1;
    const auto open_of = [&](std::size_t pixel) -> float {
        if (places.seen[pixel] == none) return 1;
        const PartDrawing& part = drawing.part_of(places.seen[pixel]);
        if (!part.has_faces()) return 1;
        const Vec3 n = shader.facing_normal(part.corners(places.seen[pixel] - part.first()));
        const std::array<float, 3> normal{static_cast<float>(n.x), static_cast<float>(n.y),
                                          static_cast<float>(n.z)};
        const std::size_t x = pixel % width, y = pixel / width;
        const Spiral& spiral = all[y / every % pattern * pattern + x / every % pattern];
        return open_at(places, spiral, pixel, normal, static_cast<float>(radius));
    };
    std::vector<float> open(places.place.size(), 1);
    ProgressScope::report_next_loop();
    parallel_for(open.size(), [&](std::size_t pixel) {
        if (pixel % width % every == 0 && pixel / width % every == 0) open[pixel] = open_of(pixel);
    });
    if (!coarse) return smoothed(places, open, static_cast<float>(radius), {}, open_of);
    // First average the evaluated pixels over a whole pattern, then fill the pixels between them.
    open = smoothed(places, open, static_cast<float>(radius), {.every = 2, .reach = 4, .of_all = false},
                    open_of);
    return smoothed(places, open, static_cast<float>(radius), {.every = 2}, open_of);
}

} // namespace facetmill
