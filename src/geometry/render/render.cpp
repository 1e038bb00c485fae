#include "geometry/render/render.hpp"

#include "base/math/simd.hpp"
#include "base/math/whole_number.hpp"
#include "base/progress.hpp"
#include "geometry/render/layers.hpp"
#include "geometry/render/legend.hpp"
#include "geometry/render/occlusion.hpp"
#include "geometry/render/srgb.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace facetmill {

namespace {

constexpr int band_rows = 32; ///< rows of samples, shaded by a single thread
constexpr std::size_t large = std::size_t{1}
                              << 14; ///< triangles with more samples are drawn by several threads

SampleBox samples_around(const std::array<Vec3, 3>& p, int first, int last, int width) {
    return samples_around(p[0], p[1], p[2], first, last, width);
}

/// Calls visit(band, number) for each band of rows with samples of a triangle that blends, triangle by
/// triangle.
template <class Visit>
void for_each_in_band(const SceneDrawing& drawing, int height, Visit&& visit) {
    for (const PartDrawing& part : drawing.parts())
        for (Index f = 0; part.painter().any_blends() && f < part.count(); ++f) {
            if (!part.painter().blends(f)) continue;
            const SampleBox box = samples_around(part.corners(f), 0, height, std::numeric_limits<int>::max());
            for (int band = box.top / band_rows; !box.empty() && band <= box.bottom / band_rows; ++band)
                visit(static_cast<std::size_t>(band), part.first() + f);
        }
}

/// The numbers of the triangles that blend and touch each band of rows, in order.
std::vector<std::vector<std::uint32_t>> in_bands(const SceneDrawing& drawing, int height) {
    const auto count = static_cast<std::size_t>((height + band_rows - 1) / band_rows);
    std::vector<std::size_t> sizes(count);
    for_each_in_band(drawing, height, [&](std::size_t band, std::uint32_t) { ++sizes[band]; });
    const double all = std::accumulate(sizes.begin(), sizes.end(), 0.0);
    require_memory(all * sizeof(std::uint32_t), "the picture", "render fewer faces or fewer rows of pixels");
    std::vector<std::vector<std::uint32_t>> bands(count);
    for (std::size_t i = 0; i < count; ++i) bands[i].reserve(sizes[i]);
    for_each_in_band(drawing, height,
                     [&](std::size_t band, std::uint32_t number) { bands[band].push_back(number); });
    return bands;
}

/// Draws a red ring with a white rim around a position in pixels.
void draw_ring(Picture& picture, double x, double y) {
    const double radius = std::max(6.0, picture.width / 60.0);
    constexpr double line = 1.5, rim = 2.5;
    const auto bound = [&](double at, int count) {
        return std::clamp(whole_number<int>(std::floor(at)), 0, count);
    };
    const double reach = radius + rim + 1;
    for (int py = bound(y - reach, picture.height); py < bound(y + reach, picture.height); ++py)
        for (int px = bound(x - reach, picture.width); px < bound(x + reach, picture.width); ++px) {
            const double dx = px + 0.5 - x, dy = py + 0.5 - y;
            const double off = std::abs(std::sqrt(dx * dx + dy * dy) - radius);
            if (off > rim) continue;
            const std::array<std::uint8_t, 4> colour = off > line
                                                           ? std::array<std::uint8_t, 4>{255, 255, 255, 255}
                                                           : std::array<std::uint8_t, 4>{200, 20, 20, 255};
            const std::size_t at = static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(px);
            std::copy(colour.begin(), colour.end(), &picture.rgba[4 * at]);
        }
}

/// A picture in progress.
class PictureDrawing {
  public:
    PictureDrawing(const Scene& scene, const PictureSettings& settings, const ValueRange& range)
        : settings_(settings), canvas_(settings.width, settings.height),
          view_(view_of(scene, settings, canvas_.width, canvas_.height)),
          drawing_(scene, settings, view_, range), shader_(drawing_, view_, settings),
          bands_(in_bands(drawing_, canvas_.height)) {}

    Picture picture() {
        ProgressSteps steps({2, 1, 3});
        draw_faces();
        draw_points();
        steps.next();
        if (settings_.occlusion && settings_.paint != Paint::normal) open_ = occluded();
        steps.next();
        ProgressScope::report_next_loop();
        Picture picture;
        picture.width = settings_.width;
        picture.height = settings_.height;
        picture.rgba.resize(canvas_.size() / (Canvas::samples * Canvas::samples) * 4);
        parallel_for(
            bands_.size(), [&](std::size_t band) { develop(band, picture); }, 1);
        for (const Vec3& mark : settings_.marks)
            if (const Vec3 seen = view_.of(mark); is_finite(seen))
                draw_ring(picture, seen.x / Canvas::samples, seen.y / Canvas::samples);
        picture.scale = view_.has_extent ? view_.scale / Canvas::samples : 0;
        picture.faces = drawing_.faces();
        return picture;
    }

  private:
    int first_row(std::size_t band) const { return static_cast<int>(band) * band_rows; }
    int last_row(std::size_t band) const { return std::min(first_row(band) + band_rows, canvas_.height); }

    void draw_faces() {
        ProgressScope::report_next_loop();
        for (const PartDrawing& part : drawing_.parts())
            if (part.has_faces()) draw_part(part);
    }

    using Faces = std::vector<Index>;

    /// Draws the small triangles in parallel, then each large triangle in parallel bands.
    void draw_part(const PartDrawing& part) {
        std::vector<SamplesAt> at(part.mesh().vertex_count());
        parallel_for(at.size(),
                     [&](std::size_t v) { at[v] = SamplesAt(part.point(static_cast<Index>(v)), canvas_); });
        const Faces large_ones = parallel_reduce(
            part.count(), Faces{},
            [&](std::size_t begin, std::size_t end) { return draw_small(part, at, begin, end); },
            [](Faces a, const Faces& b) {
                a.insert(a.end(), b.begin(), b.end());
                return a;
            },
            4096);
        if (large_ones.empty()) return;
        parallel_for(
            bands_.size(),
            [&](std::size_t band) {
                for (const Index f : large_ones) {
                    const auto corners = part.corners(f);
                    draw_face(part, f, corners,
                              samples_around(corners, first_row(band), last_row(band), canvas_.width));
                }
            },
            1);
    }

    /// Draws the small triangles of a range and returns the large triangles. Prefetches data of later
    /// triangles, because it may be anywhere in memory.
    Faces draw_small(const PartDrawing& part, const std::vector<SamplesAt>& at, std::size_t begin,
                     std::size_t end) {
        struct Asked {
            Index face;
            SampleBox box;
        };
        constexpr std::size_t ahead = 16;
        const Mesh& mesh = part.mesh();
        Faces large_ones;
        std::array<Asked, 32> asked;
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const auto f = static_cast<Index>(i);
            for (Index c = 3 * (f + ahead); i + ahead < end && c < 3 * (f + ahead) + 3; ++c)
                fetch_soon(at[mesh.vertex(c)]);
            const SampleBox box = SamplesAt::around(at[mesh.vertex(3 * f)], at[mesh.vertex(3 * f + 1)],
                                                    at[mesh.vertex(3 * f + 2)]);
            if (box.size() > large && !box.empty())
                large_ones.push_back(f);
            else if (!box.empty()) {
                for (Index k = 0; k < 3; ++k) fetch_soon(part.corner(f, k));
                asked[count++] = {f, box};
            }
            if (count < asked.size() && i + 1 < end) continue;
            for (const Asked& one : std::span(asked).first(std::exchange(count, 0)))
                if (const auto corners = part.corners(one.face); !is_hidden(corners, one.box))
                    draw_face(part, one.face, corners, one.box);
        }
        return large_ones;
    }

    /// Whether nearer triangles already cover all samples of a small triangle. This test skips most
    /// triangles cheaply.
    bool is_hidden(const std::array<Vec3, 3>& corners, const SampleBox& box) {
        constexpr std::size_t few = 16;
        if (box.size() > few) return false;
        const auto nearest = static_cast<float>(nearest_depth(corners));
        if (!(nearest < HUGE_VALF)) return false;
        for (int y = box.top; y <= box.bottom; ++y)
            for (int x = box.left; x <= box.right; ++x)
                if (!canvas_.hides(canvas_.at(x, y), nearest)) return false;
        return true;
    }

    /// Draws the triangle's samples in the box, unless it blends.
    void draw_face(const PartDrawing& part, Index face, const std::array<Vec3, 3>& corners,
                   const SampleBox& box) {
        const CanvasTriangle t(corners);
        if (!t.drawn() || part.painter().blends(face)) return;
        const bool holes = part.painter().has_holes(face);
        for_each_sample(t, part.front(t.p), box, [&](int x, int y, double z) {
            if (!holes || shader_.is_solid(part, t, face, x + 0.5, y + 0.5))
                canvas_.put(x, y, z, part.first() + face);
        });
    }

    void draw_points() {
        for (const PartDrawing& part : drawing_.parts()) {
            draw_lines(part);
            for (Index v = 0; !part.has_faces() && v < part.count(); ++v)
                if (is_finite(part.point(v)))
                    draw_dot(part.point(v), settings_.point, part.first() + v, canvas_);
        }
    }

    /// Draws lines as dots, a sample apart.
    void draw_lines(const PartDrawing& part) {
        const Mesh& mesh = part.mesh();
        for (std::size_t l = 0; l < mesh.line_count(); ++l) {
            const Index ends[] = {mesh.vertex_of_wedge(mesh.lines[2 * l]),
                                  mesh.vertex_of_wedge(mesh.lines[2 * l + 1])};
            const Vec3 &a = part.point(ends[0]), &b = part.point(ends[1]);
            const auto seen = part_within(a, b);
            if (!seen) continue;
            const auto [from, to] = *seen;
            const double samples = (to - from) * std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
            const auto steps = static_cast<int>(std::ceil(samples)) + 1;
            for (int i = 0; i <= steps; ++i) {
                const double t = from + (to - from) * i / steps;
                draw_dot(a + (b - a) * t, settings_.point, part.first() + ends[t > 0.5], canvas_);
            }
        }
    }

    /// The part of the line from a to b on the canvas, as shares of the line (Liang, Barsky, "A new concept
    /// and method for line clipping", 1984). None if the line misses the canvas or is not finite.
    std::optional<std::pair<double, double>> part_within(const Vec3& a, const Vec3& b) const {
        if (!is_finite(a) || !is_finite(b)) return {};
        double from = 0, to = 1;
        const double sizes[] = {static_cast<double>(canvas_.width), static_cast<double>(canvas_.height)};
        for (std::size_t c = 0; c < 2; ++c) {
            const double along = b[c] - a[c];
            if (along == 0) {
                if (a[c] < 0 || a[c] > sizes[c]) return {};
                continue;
            }
            const double low = -a[c] / along, high = (sizes[c] - a[c]) / along;
            from = std::max(from, std::min(low, high));
            to = std::min(to, std::max(low, high));
        }
        if (!(from <= to)) return {};
        return std::pair(from, to);
    }

    std::vector<float> occluded() const {
        // An eighth of the scene, scaled by the zoom.
        const double radius = std::min(canvas_.width, canvas_.height) / 8.0 * settings_.zoom;
        const double most = std::min(canvas_.width, canvas_.height) / 4.0;
        return open_sky(canvas_, drawing_, shader_, view_, std::min(radius, most),
                        settings_.coarse_occlusion);
    }

    /// Shades the rows of pixels of a band.
    void develop(std::size_t band, Picture& picture) const {
        LastFacings last;
        const Layers layers(bands_[band], first_row(band), last_row(band), canvas_, drawing_, shader_, last);
        for (int y = first_row(band) / Canvas::samples; y < last_row(band) / Canvas::samples; ++y)
            for (int x = 0; x < settings_.width; ++x) {
                const std::size_t pixel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                    static_cast<std::size_t>(x);
                const Texel sum = pixel_sum(x, y, layers, open_.empty() ? 1 : open_[pixel], last);
                store(sum, &picture.rgba[4 * pixel]);
            }
    }

    /// The sum over the samples of a pixel, with colours multiplied by alpha.
    Texel pixel_sum(int x, int y, const Layers& layers, float open, LastFacings& last) const {
        constexpr int n = Canvas::samples;
        std::array<Texel, n* n> shades = solid_samples(x, y, open, last);
        layers.lay_over(x, y, shades);
        Texel sum{};
        for (const Texel& shade : shades) {
            for (std::size_t c = 0; c < 4; ++c) sum[c] += shade[c];
            if (!settings_.ground) continue;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += (1 - shade[3]) * (*settings_.ground)[c];
            sum[3] += 1 - shade[3];
        }
        return sum;
    }

    /// The opaque surface at each sample of a pixel, with a single shade per face.
    std::array<Texel, Canvas::samples * Canvas::samples> solid_samples(int x, int y, float open,
                                                                       LastFacings& last) const {
        constexpr int n = Canvas::samples;
        std::array<std::uint32_t, n * n> seen{};
        for (int i = 0; i < n * n; ++i)
            seen[static_cast<std::size_t>(i)] = canvas_.seen(canvas_.at(n * x + i % n, n * y + i / n));
        std::array<Texel, n * n> shades{};
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (seen[i] == none) continue;
            const auto before =
                static_cast<std::size_t>(std::find(seen.begin(), seen.end(), seen[i]) - seen.begin());
            shades[i] = before < i ? shades[before] : shade_of(x, y, seen, seen[i], open, last);
        }
        for (std::size_t i = 0; i < seen.size(); ++i)
            if (seen[i] != none)
                darken_lines(n * x + static_cast<int>(i) % n, n * y + static_cast<int>(i) / n, seen[i],
                             shades[i]);
        return shades;
    }

    Texel shade_of(int x, int y, const std::array<std::uint32_t, Canvas::samples * Canvas::samples>& seen,
                   std::uint32_t number, float open, LastFacings& last) const {
        constexpr int n = Canvas::samples;
        double sum_x = 0, sum_y = 0, count = 0;
        for (int i = 0; i < n * n; ++i) {
            if (seen[static_cast<std::size_t>(i)] != number) continue;
            sum_x += n * x + i % n + 0.5;
            sum_y += n * y + i / n + 0.5;
            ++count;
        }
        Texel shade = shader_.colour(number, sum_x / count, sum_y / count, open, last);
        for (float& c : shade) c = std::min(c, 1.0f);
        shade[3] = 1;
        return shade;
    }

    void darken_lines(int x, int y, std::uint32_t number, Texel& shade) const {
        float dim = 1;
        const PartDrawing& part = drawing_.part_of(number);
        if (part.has_lines()) {
            const Index face = number - part.first();
            if (part.triangle(face).nearest_edge(x + 0.5, y + 0.5, part.lines(face)) < 0.75) dim = 0.45f;
        }
        if (settings_.silhouettes && on_silhouette(x, y)) dim = 0.1f;
        for (std::size_t c = 0; c < 3; ++c) shade[c] *= dim;
    }

    /// Whether the depth jumps, two samples away, by more than the slope explains.
    bool on_silhouette(int x, int y) const {
        constexpr int step = Canvas::samples;
        const double jump = 0.015 * std::max(canvas_.width, canvas_.height);
        const auto depth = [&](int qx, int qy) -> double {
            if (qx < 0 || qy < 0 || qx >= canvas_.width || qy >= canvas_.height) return -HUGE_VAL;
            return static_cast<double>(canvas_.depth(canvas_.at(qx, qy)));
        };
        const double here = depth(x, y);
        for (const auto& [dx, dy] : {std::pair{step, 0}, std::pair{0, step}}) {
            const double a = depth(x - dx, y - dy), b = depth(x + dx, y + dy);
            if (a == -HUGE_VAL || b == -HUGE_VAL) return true;
            if (2 * here - a - b > jump && here - std::min(a, b) > jump) return true;
        }
        return false;
    }

    /// Stores the mean of the covered samples, with their share as alpha.
    static void store(const Texel& sum, std::uint8_t* to) {
        if (!(sum[3] > 0)) return;
        for (std::size_t c = 0; c < 3; ++c) to[c] = srgb_of(sum[c] / sum[3]);
        constexpr float count = Canvas::samples * Canvas::samples;
        to[3] = static_cast<std::uint8_t>(std::floor(255 * std::min(sum[3] / count, 1.0f)));
    }

    const PictureSettings& settings_;
    Canvas canvas_;
    View view_;
    SceneDrawing drawing_;
    Shader shader_;
    std::vector<std::vector<std::uint32_t>> bands_;
    std::vector<float> open_; ///< per pixel; empty: 1 everywhere
};

bool any_part_has(const Scene& scene, const PictureSettings& settings) {
    return std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return (!settings.shows || settings.shows(part)) && attribute_to_show(part.mesh, settings.attribute);
    });
}

ValueRange painted_range(const Scene& scene, const PictureSettings& settings) {
    if (settings.attribute.empty()) return {};
    return value_range(scene, settings.attribute, settings.range, settings.shows);
}

/// The settings for the part of the picture that the legend leaves free.
PictureSettings beside_legend(const PictureSettings& settings, const ValueRange& range) {
    PictureSettings own = settings;
    own.width -= legend_width(settings, range);
    return own;
}

} // namespace

Picture picture_of(const Scene& scene, const PictureSettings& settings) {
    require_memory(64.0 * settings.width * settings.height, "the picture", "render fewer pixels");
    const ValueRange range = painted_range(scene, settings);
    const PictureSettings own = beside_legend(settings, range);
    ProgressSteps steps({1, 3});
    PictureDrawing drawing(scene, own, range);
    steps.next();
    Picture picture = drawing.picture();
    picture.range = range;
    picture.has_attribute = !settings.attribute.empty() && any_part_has(scene, settings);
    return own.width < settings.width ? with_legend(picture, settings, range) : picture;
}

double fitting_scale(const Scene& scene, const PictureSettings& settings) {
    PictureSettings plain = beside_legend(settings, painted_range(scene, settings));
    plain.zoom = 1;
    return view_of(scene, plain, Canvas::samples * plain.width, Canvas::samples * plain.height).scale /
           Canvas::samples;
}

Picture sheet_of(const std::vector<Picture>& pictures, std::size_t columns) {
    Picture sheet;
    if (pictures.empty()) return sheet;
    sheet = pictures.front();
    const std::size_t rows = (pictures.size() + columns - 1) / columns;
    const std::size_t row = 4 * static_cast<std::size_t>(sheet.width),
                      height = static_cast<std::size_t>(sheet.height);
    sheet.width *= static_cast<int>(columns);
    sheet.height *= static_cast<int>(rows);
    sheet.rgba.assign(row * columns * height * rows, 0);
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (std::size_t y = 0; y < height; ++y) {
            const std::size_t to = ((i / columns * height + y) * columns + i % columns) * row;
            std::copy_n(&pictures[i].rgba[y * row], row, &sheet.rgba[to]);
        }
    return sheet;
}

} // namespace facetmill
