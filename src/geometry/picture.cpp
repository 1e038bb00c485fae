#include "geometry/picture.hpp"

#include "base/parallel.hpp"
#include "mesh/placement.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

constexpr int samples = 2;    ///< a side of each pixel
constexpr int band_rows = 32; ///< of samples, drawn by one thread

using Colour = std::array<float, 3>; ///< linear
constexpr Colour inside{0.75f, 0.3f, 0.12f};

/// World to samples: x right, y down, z towards the viewer.
struct View {
    Vec3 right, up, towards;
    double scale = 1, x = 0, y = 0;

    Vec3 of(const Vec3& p) const {
        return {dot(p, right) * scale + x, -dot(p, up) * scale + y, dot(p, towards) * scale};
    }
};

View view_of(const Scene& scene, int width, int height) {
    const Vec3 extent = scene.bounds().extent();
    const bool z_up = scene.up == UpAxis::z || (scene.up == UpAxis::unknown && extent.z >= extent.y);
    const Vec3 up = z_up ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, front = z_up ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
    View view;
    view.towards = normalised(front + Vec3{0.55, 0, 0} + up * 0.45);
    view.right = normalised(cross(up, view.towards));
    view.up = cross(view.towards, view.right);
    Box seen;
    for (const Part& part : scene.parts) {
        const Transform to_world = effective(part);
        seen.add(parallel_reduce(
            part.mesh.vertex_count(), Box{},
            [&](std::size_t begin, std::size_t end) {
                Box box;
                for (std::size_t v = begin; v < end; ++v)
                    if (const Vec3 p = view.of(to_world.point(part.mesh.positions[v])); is_finite(p))
                        box.add(p);
                return box;
            },
            [](Box a, const Box& b) { return a.add(b), a; }));
    }
    if (seen.empty()) return view;
    const Vec3 size = seen.extent(), middle = seen.centre();
    const double tallest = std::max(size.x / width, size.y / height);
    view.scale = tallest > 0 ? 0.92 / tallest : 1;
    view.x = width / 2.0 - middle.x * view.scale, view.y = height / 2.0 - middle.y * view.scale;
    return view;
}

/// What has been drawn so far.
struct Canvas {
    int width, height;
    std::vector<float> depth;
    std::vector<Colour> colours;

    Canvas(int w, int h)
        : width(w), height(h), depth(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), -HUGE_VALF),
          colours(depth.size()) {}

    void put(int x, int y, double z, const Colour& colour) {
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        if (!(static_cast<float>(z) > depth[at])) return;
        depth[at] = static_cast<float>(z), colours[at] = colour;
    }
};

/// A triangle on the canvas, seen anticlockwise or not.
struct Triangle {
    std::array<Vec3, 3> p;
    double area = 0; ///< twice, positive when the front is seen

    explicit Triangle(const std::array<Vec3, 3>& corners) : p(corners) {
        area = (p[2].x - p[0].x) * (p[1].y - p[0].y) - (p[1].x - p[0].x) * (p[2].y - p[0].y);
    }
    bool drawn() const { return area != 0 && is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]); }
    /// The unit normal towards the viewer.
    Vec3 normal() const {
        const Vec3 n = normalised(cross(p[1] - p[0], p[2] - p[0]));
        return n.z < 0 ? -n
                       : n; // y points down, which turns the triangle over; the side seen is told by area
    }
};

Colour shaded(const Colour& base, const Vec3& normal) {
    const Vec3 light = normalised(Vec3{-0.35, -0.55, 0.75}); // from the upper left of the viewer
    const auto amount = static_cast<float>(0.16 + 0.84 * std::max(0.0, dot(normal, light)));
    return {base[0] * amount, base[1] * amount, base[2] * amount};
}

/// Draws the rows [first, last) of the triangle.
void draw(const Triangle& t, const Colour& colour, bool edges, int first, int last, Canvas& canvas) {
    const auto [x0, x1] = std::minmax({t.p[0].x, t.p[1].x, t.p[2].x});
    const auto [y0, y1] = std::minmax({t.p[0].y, t.p[1].y, t.p[2].y});
    const int left = std::max(0, static_cast<int>(std::ceil(x0 - 0.5)));
    const int right = std::min(canvas.width - 1, static_cast<int>(std::floor(x1 - 0.5)));
    const int top = std::max(first, static_cast<int>(std::ceil(y0 - 0.5)));
    const int bottom = std::min(last - 1, static_cast<int>(std::floor(y1 - 0.5)));
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 e = t.p[(i + 2) % 3] - t.p[(i + 1) % 3];
        lengths[i] = std::sqrt(e.x * e.x + e.y * e.y);
    }
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            double z = 0, nearest_edge = HUGE_VAL;
            bool covered = true;
            for (std::size_t i = 0; i < 3 && covered; ++i) {
                const Vec3 &a = t.p[(i + 1) % 3], &b = t.p[(i + 2) % 3];
                const double w = ((b.y - a.y) * (x + 0.5 - a.x) - (b.x - a.x) * (y + 0.5 - a.y)) / t.area;
                covered = w >= 0;
                z += w * t.p[i].z;
                if (edges) nearest_edge = std::min(nearest_edge, w * std::abs(t.area) / lengths[i]);
            }
            if (!covered) continue;
            const float dim = nearest_edge < 0.75 ? 0.45f : 1;
            canvas.put(x, y, z, {colour[0] * dim, colour[1] * dim, colour[2] * dim});
        }
}

/// The triangles of a part that touch each band of rows, in order.
std::vector<std::vector<Index>> in_bands(const Mesh& mesh, const std::vector<Vec3>& points, int height) {
    std::vector<std::vector<Index>> bands(static_cast<std::size_t>((height + band_rows - 1) / band_rows));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        double top = HUGE_VAL, bottom = -HUGE_VAL;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            const double y = points[mesh.vertex(c)].y;
            top = std::min(top, y), bottom = std::max(bottom, y);
        }
        if (!(top < height && bottom >= 0)) continue; // NaN too
        const auto last = static_cast<std::size_t>(std::min<double>(bottom, height - 1) / band_rows);
        for (auto b = static_cast<std::size_t>(std::max(top, 0.0) / band_rows); b <= last; ++b)
            bands[b].push_back(f);
    }
    return bands;
}

struct Look {
    Colour colour{0.72f, 0.74f, 0.78f};
    bool double_sided = false;
};

std::vector<Look> looks_of(const Mesh& mesh, const Scene& scene) {
    std::vector<Look> looks(std::max<std::size_t>(1, mesh.primitives.size()));
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        if (mesh.primitives[i].material >= scene.materials.size()) continue;
        const Material& material = scene.materials[mesh.primitives[i].material];
        for (std::size_t c = 0; c < 3; ++c)
            looks[i].colour[c] *= static_cast<float>(std::clamp(material.base_colour[c], 0.0, 1.0));
        looks[i].double_sided = material.double_sided;
    }
    return looks;
}

void draw_faces(const Mesh& mesh, const Scene& scene, const std::vector<Vec3>& points, bool edges,
                Canvas& canvas) {
    const auto looks = looks_of(mesh, scene);
    const auto bands = in_bands(mesh, points, canvas.height);
    parallel_for(
        bands.size(),
        [&](std::size_t band) {
            const int first = static_cast<int>(band) * band_rows, last = first + band_rows;
            for (const Index f : bands[band]) {
                const Triangle t({points[mesh.vertex(3 * f)], points[mesh.vertex(3 * f + 1)],
                                  points[mesh.vertex(3 * f + 2)]});
                if (!t.drawn()) continue;
                const Look& look = looks[std::min<std::size_t>(mesh.primitive_of(f), looks.size() - 1)];
                const Colour& base = t.area > 0 || look.double_sided ? look.colour : inside;
                draw(t, shaded(base, t.normal()), edges, first, std::min(last, canvas.height), canvas);
            }
        },
        1);
}

void draw_points(const std::vector<Vec3>& points, Canvas& canvas) {
    for (const Vec3& p : points) {
        if (!is_finite(p)) continue;
        const int x = static_cast<int>(std::clamp<double>(p.x, 0, canvas.width - 1));
        const int y = static_cast<int>(std::clamp<double>(p.y, 0, canvas.height - 1));
        canvas.put(x, y, p.z, Look{}.colour);
    }
}

/// The means of each pixel's samples; the square root is near enough to sRGB's curve for a picture.
Picture developed(const Canvas& canvas) {
    Picture picture{canvas.width / samples, canvas.height / samples, {}};
    picture.rgba.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                        4);
    parallel_for(picture.rgba.size() / 4, [&](std::size_t pixel) {
        const std::size_t w = static_cast<std::size_t>(picture.width), x = pixel % w, y = pixel / w;
        Colour sum{};
        int covered = 0;
        for (std::size_t i = 0; i < samples * samples; ++i) {
            const std::size_t at = (y * samples + i / samples) * w * samples + x * samples + i % samples;
            if (canvas.depth[at] == -HUGE_VALF) continue;
            ++covered;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += canvas.colours[at][c];
        }
        if (covered == 0) return;
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgba[4 * pixel + c] =
                static_cast<std::uint8_t>(255 * std::sqrt(sum[c] / static_cast<float>(covered)) + 0.5f);
        picture.rgba[4 * pixel + 3] = static_cast<std::uint8_t>(255 * covered / (samples * samples));
    });
    return picture;
}

} // namespace

Picture picture_of(const Scene& scene, const PictureSettings& settings) {
    Canvas canvas(settings.width * samples, settings.height * samples);
    const View view = view_of(scene, canvas.width, canvas.height);
    const bool few = scene.face_count() <= settings.edges_up_to;
    for (const Part& part : scene.parts) {
        const Transform to_world = effective(part);
        std::vector<Vec3> points(part.mesh.vertex_count());
        parallel_for(points.size(),
                     [&](std::size_t v) { points[v] = view.of(to_world.point(part.mesh.positions[v])); });
        if (part.mesh.face_count() == 0)
            draw_points(points, canvas);
        else if (part.mesh.all_triangles())
            draw_faces(part.mesh, scene, points, few, canvas);
        else
            draw_faces(triangulated(part.mesh), scene, points, false, canvas);
    }
    return developed(canvas);
}

} // namespace facetmill
