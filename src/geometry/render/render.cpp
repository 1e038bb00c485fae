#include "geometry/render/render.hpp"
#include "geometry/triangulate/crossing_faces.hpp"

#include "base/parallel.hpp"
#include "geometry/render/painter.hpp"

#include <algorithm>

namespace facetmill {

namespace {

constexpr int band_rows = 32; ///< of samples, drawn by one thread

/// World to samples: x right, y down, z towards the viewer, 0 in the middle of what is seen.
struct View {
    Vec3 right, up, towards;
    double scale = 0, x = 0, y = 0, z = 0; ///< the scene's middle goes to the canvas' middle

    Vec3 of(const Vec3& p) const {
        return {dot(p, right) * scale + x, -dot(p, up) * scale + y, dot(p, towards) * scale + z};
    }
};

Vec3 direction(Viewpoint viewpoint, const Vec3& up, const Vec3& front) {
    const Vec3 right = cross(up, front);
    switch (viewpoint) {
    case Viewpoint::front:
        return front;
    case Viewpoint::back:
        return -front;
    case Viewpoint::left:
        return -right;
    case Viewpoint::right:
        return right;
    case Viewpoint::top:
        return up;
    case Viewpoint::bottom:
        return -up;
    case Viewpoint::corner:
        break;
    }
    return front + right * 0.55 + up * 0.45;
}

View axes_of(const Scene& scene, const PictureSettings& settings) {
    const Vec3 extent = scene.bounds().extent();
    const bool z_up = scene.up == UpAxis::z || (scene.up == UpAxis::unknown && extent.z >= extent.y);
    const Vec3 up = z_up ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, front = z_up ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
    View view;
    view.towards = normalised(settings.from.value_or(direction(settings.viewpoint, up, front)));
    Vec3 right = cross(up, view.towards);
    // From straight above or below, the front is at the bottom or the top of the picture.
    if (length(right) < 1e-9) right = cross(dot(up, view.towards) > 0 ? -front : front, view.towards);
    view.right = normalised(right);
    view.up = cross(view.towards, view.right);
    return view;
}

bool shown(const Part& part, const PictureSettings& settings) {
    return !settings.shows || settings.shows(part);
}

/// The box of what is seen along the view's axes, in units of the scene.
Box seen_box(const Scene& scene, const PictureSettings& settings, View view) {
    view.scale = 1;
    Box seen;
    for (const Part& part : scene.parts) {
        if (!shown(part, settings)) continue;
        const Transform to_world = part.transform;
        seen.add(parallel_reduce(
            part.mesh.vertex_count(), Box{},
            [&](std::size_t begin, std::size_t end) {
                Box box;
                for (std::size_t v = begin; v < end; ++v)
                    if (const Vec3 p = view.of(to_world.point(part.mesh.positions[v])); is_finite(p))
                        box.add(p);
                return box;
            },
            [](Box a, const Box& b) {
                a.add(b);
                return a;
            }));
    }
    return seen;
}

View view_of(const Scene& scene, const PictureSettings& settings, const Canvas& canvas) {
    View view = axes_of(scene, settings);
    const Box seen = seen_box(scene, settings, view);
    if (seen.empty()) return view;
    const Vec3 size = seen.extent(), middle = seen.centre();
    const double tallest = std::max(size.x / canvas.width, size.y / canvas.height);
    view.scale = tallest > 0 ? 0.92 / tallest : 1;
    view.x = canvas.width / 2.0 - middle.x * view.scale;
    view.y = canvas.height / 2.0 - middle.y * view.scale;
    view.z = -middle.z * view.scale;
    return view;
}

/// The triangles of a part that touch each band of rows, in order.
std::vector<std::vector<Index>> in_bands(const Mesh& mesh, const std::vector<Vec3>& points, int height) {
    std::vector<std::vector<Index>> bands(static_cast<std::size_t>((height + band_rows - 1) / band_rows));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        double top = HUGE_VAL, bottom = -HUGE_VAL;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            const double y = points[mesh.vertex(c)].y;
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
        if (!(top < height && bottom >= 0)) continue; // NaN too
        const auto last = static_cast<std::size_t>(std::min<double>(bottom, height - 1) / band_rows);
        for (auto b = static_cast<std::size_t>(std::max(top, 0.0) / band_rows); b <= last; ++b)
            bands[b].push_back(f);
    }
    return bands;
}

/// The edges of polygons, so that those that triangles have inside are not drawn.
class RealEdges {
  public:
    explicit RealEdges(const Mesh& mesh) {
        if (mesh.all_triangles()) return;
        edges_.reserve(mesh.corner_count());
        for (Index f = 0; f < mesh.face_count(); ++f)
            for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                edges_.push_back(
                    key(mesh.vertex(c), mesh.vertex(c + 1 < mesh.face_end(f) ? c + 1 : mesh.face_begin(f))));
        std::sort(edges_.begin(), edges_.end());
    }
    bool has(Index a, Index b) const {
        return edges_.empty() || std::binary_search(edges_.begin(), edges_.end(), key(a, b));
    }

  private:
    static std::uint64_t key(Index a, Index b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }
    std::vector<std::uint64_t> edges_; ///< empty: all are real
};

/// How much of its colour a face shows.
float lit(const CanvasTriangle& t, Shading shading, bool double_sided) {
    const Vec3 light = normalised(Vec3{-0.35, -0.55, 0.75}); // from the upper left of the viewer
    const Vec3 n = t.towards_viewer();
    double amount = dot(n, light);
    if (shading == Shading::one_sided && t.area < 0 && !double_sided) amount = -amount;
    if (shading == Shading::absolute) amount = std::abs(amount);
    return static_cast<float>(0.16 + 0.84 * std::max(0.0, amount));
}

/// One part, its points already on the canvas.
class PartDrawing {
  public:
    PartDrawing(const Part& part, const Mesh& triangles, const Painter& painter, const View& view,
                const PictureSettings& settings)
        : mesh_(triangles), painter_(painter), view_(view), settings_(settings),
          points_(triangles.vertex_count()) {
        const Transform to_world = part.transform;
        parallel_for(points_.size(),
                     [&](std::size_t v) { points_[v] = view.of(to_world.point(mesh_.positions[v])); });
    }

    void draw_faces(const RealEdges* lines, Canvas& canvas) const {
        const auto bands = in_bands(mesh_, points_, canvas.height);
        parallel_for(
            bands.size(),
            [&](std::size_t band) {
                const int first = static_cast<int>(band) * band_rows;
                for (const Index f : bands[band]) {
                    CanvasTriangle t({point(f, 0), point(f, 1), point(f, 2)});
                    if (!t.drawn()) continue;
                    paint(t, f, lines);
                    draw(t, first, std::min(first + band_rows, canvas.height), canvas);
                }
            },
            1);
    }

    void draw_points(Canvas& canvas) const {
        for (Index v = 0; v < points_.size(); ++v)
            if (is_finite(points_[v]))
                draw_dot(points_[v], settings_.point, painter_.of(none, mesh_.has_seams() ? none : v),
                         canvas);
    }

  private:
    const Vec3& point(Index f, Index k) const { return points_[mesh_.vertex(3 * f + k)]; }

    void paint(CanvasTriangle& t, Index f, const RealEdges* lines) const {
        constexpr Colour inside{0.75f, 0.3f, 0.12f};
        const bool double_sided = painter_.double_sided(f);
        const bool turned = settings_.shading == Shading::sides && t.area < 0 && !double_sided;
        const float amount = lit(t, settings_.shading, double_sided);
        for (Index k = 0; k < 3; ++k) {
            Colour base = turned ? inside : painter_.of(f, mesh_.corners[3 * f + k]);
            if (painter_.by_normal()) base = of_normal(t);
            for (std::size_t c = 0; c < 3; ++c)
                t.colours[k][c] = base[c] * (painter_.by_normal() ? 1 : amount);
            const Index a = mesh_.vertex(3 * f + (k + 1) % 3), b = mesh_.vertex(3 * f + (k + 2) % 3);
            t.lines[k] = lines && lines->has(a, b);
        }
    }

    /// x y z of the face's own normal in the world, from 0 to 1.
    Colour of_normal(const CanvasTriangle& t) const {
        Vec3 n = t.towards_viewer();
        if (t.area < 0) n = -n;
        const Vec3 world = view_.right * n.x - view_.up * n.y + view_.towards * n.z;
        Colour colour{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto x = static_cast<float>(0.5 + 0.5 * world[c]);
            colour[c] = x * x; // developed() takes the root
        }
        return colour;
    }

    const Mesh& mesh_;
    const Painter& painter_;
    const View& view_;
    const PictureSettings& settings_;
    std::vector<Vec3> points_;
};

} // namespace

Picture picture_of(const Scene& scene, const PictureSettings& settings) {
    Canvas canvas(settings.width, settings.height);
    const View view = view_of(scene, settings, canvas);
    bool found = false;
    const auto range = range_of(scene, settings, found).value_or(std::array<double, 2>{0, 0});
    const bool lines = settings.edges == EdgeLines::all ||
                       (settings.edges == EdgeLines::few && scene.face_count() <= settings.few);
    std::size_t number = 0, faces = 0;
    for (const Part& part : scene.parts) {
        if (!shown(part, settings)) continue;
        faces += part.mesh.face_count();
        const Mesh cut = part.mesh.all_triangles() ? Mesh{} : triangles_of(part.mesh);
        const Mesh& triangles = part.mesh.all_triangles() ? part.mesh : cut;
        const Painter painter(triangles, scene, settings, number++, range);
        const PartDrawing drawing(part, triangles, painter, view, settings);
        if (part.mesh.face_count() == 0)
            drawing.draw_points(canvas);
        else if (lines) {
            const RealEdges real(part.mesh);
            drawing.draw_faces(&real, canvas);
        } else
            drawing.draw_faces(nullptr, canvas);
    }
    Picture picture = developed(canvas, settings.ground);
    picture.scale = view.scale / Canvas::samples;
    picture.faces = faces;
    picture.range = range;
    picture.has_attribute = found;
    return picture;
}

Picture beside(const Picture& left, const Picture& right) {
    Picture both = left;
    both.width = left.width + right.width;
    both.rgba.clear();
    both.rgba.reserve(left.rgba.size() + right.rgba.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(left.height); ++y)
        for (const Picture* p : {&left, &right}) {
            const std::size_t row = 4 * static_cast<std::size_t>(p->width);
            const auto begin = p->rgba.begin() + static_cast<std::ptrdiff_t>(y * row);
            both.rgba.insert(both.rgba.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
        }
    return both;
}

} // namespace facetmill
