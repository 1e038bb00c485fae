#include "geometry/render/view.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/render/canvas.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace facetmill {

namespace {

bool is_shown(const Part& part, const PictureSettings& settings) {
    return !settings.shows || settings.shows(part);
}

/// [vertices] whether a vertex is drawn. If the mesh has faces, isolated vertices are not.
std::vector<std::uint8_t> drawn_vertices(const Mesh& mesh) {
    std::vector<std::uint8_t> drawn(mesh.vertex_count(), mesh.face_count() == 0);
    for (Index c = 0; c < mesh.corner_count(); ++c) drawn[mesh.vertex(c)] = 1;
    return drawn;
}

/// Caches drawn_vertices of the parts of a scene, computed on first use.
class DrawnVertices {
  public:
    const std::vector<std::uint8_t>& of(const Part& part) {
        auto& known = drawn_[&part];
        if (known.empty()) known = drawn_vertices(part.mesh);
        return known;
    }

  private:
    std::map<const Part*, std::vector<std::uint8_t>> drawn_;
};

/// The box of the visible points as `seen_at` gives them.
template <class SeenAt>
Box seen_box(const Scene& scene, const PictureSettings& settings, DrawnVertices& all_drawn,
             SeenAt&& seen_at) {
    Box seen;
    for (const Part& part : scene.parts) {
        if (!is_shown(part, settings)) continue;
        const Transform to_world = part.transform;
        const auto& drawn = all_drawn.of(part);
        seen.add(parallel_reduce(
            part.mesh.vertex_count(), Box{},
            [&](std::size_t begin, std::size_t end) {
                Box box;
                for (std::size_t v = begin; v < end; ++v) {
                    if (!drawn[v]) continue;
                    const Vec3 p = seen_at(to_world.point(part.mesh.positions[v]));
                    if (is_finite(p)) box.add(p);
                }
                return box;
            },
            [](Box a, const Box& b) {
                a.add(b);
                return a;
            }));
    }
    return seen;
}

/// Twice the area vector of a face.
Vec3 area_vector(const Part& part, Index face) {
    const Mesh& mesh = part.mesh;
    const Index begin = mesh.face_begin(face), end = mesh.face_end(face);
    const Vec3 origin = part.transform.point(mesh.point(begin));
    Vec3 sum;
    for (Index c = begin + 1; c + 1 < end; ++c)
        sum += cross(part.transform.point(mesh.point(c)) - origin,
                     part.transform.point(mesh.point(c + 1)) - origin);
    return sum;
}

/// Measurements that determine the up and front axes of a scene.
struct Stance {
    double y_base = 0, z_base = 0; ///< the area of faces at the lower end of y or z that face straight down
    Vec3 net;                      ///< the sum of the area vectors: zero for closed surfaces
    double area = 0;
};

Stance operator*(const Stance& s, double factor) {
    return {s.y_base * factor, s.z_base * factor, s.net * factor, s.area * factor};
}

Stance joined(Stance a, const Stance& b) {
    a.y_base += b.y_base;
    a.z_base += b.z_base;
    a.net += b.net;
    a.area += b.area;
    return a;
}

void add_face(const Part& part, Index face, const Box& box, Stance& stance) {
    const Vec3 vector = area_vector(part, face);
    const double area = length(vector);
    if (!std::isfinite(area) || part.mesh.face_size(face) < 3) return;
    stance.net += vector;
    stance.area += area;
    constexpr double straight = 0.966, thin = 0.02; // within 15 degrees, and 2 % of the height
    const Vec3 p = part.transform.point(part.mesh.point(part.mesh.face_begin(face))), size = box.extent();
    if (-vector.y > straight * area && p.y - box.min.y < thin * size.y) stance.y_base += area;
    if (-vector.z > straight * area && p.z - box.min.z < thin * size.z) stance.z_base += area;
}

/// Parts with more faces measure every n-th face, because only shares of the surface matter.
constexpr std::size_t many_faces = 200000;

Stance stance_of(const Scene& scene, const PictureSettings& settings, const Box& box) {
    Stance all;
    for (const Part& part : scene.parts) {
        if (!is_shown(part, settings)) continue;
        const std::size_t faces = part.mesh.face_count(), step = 1 + faces / many_faces;
        Stance of_part =
            parallel_reduce((faces + step - 1) / step, Stance{},
                            [&](std::size_t begin, std::size_t end) {
                                Stance stance;
                                for (std::size_t f = begin * step; f < std::min(end * step, faces); f += step)
                                    if (part.mesh.face_size(static_cast<Index>(f)) >= 3)
                                        add_face(part, static_cast<Index>(f), box, stance);
                                return stance;
                            },
                            joined);
        all = joined(all, of_part * static_cast<double>(step));
    }
    return all;
}

struct UpAndFront {
    Vec3 up, front;
};

UpAndFront up_and_front(const Scene& scene, const PictureSettings& settings, DrawnVertices& drawn) {
    const UpAndFront y_up{{0, 1, 0}, {0, 0, 1}}, z_up{{0, 0, 1}, {0, -1, 0}};
    if (scene.up != UpAxis::unknown) return scene.up == UpAxis::z ? z_up : y_up;
    const Box box = seen_box(scene, {}, drawn, [](const Vec3& p) { return p; });
    const Vec3 extent = box.extent();
    const Stance stance = stance_of(scene, settings, box);
    // A base counts if it covers 3 % of the surface and more than twice the area of the other direction's
    // base.
    const bool stands_on_y = stance.y_base > 0.03 * stance.area && stance.y_base > 2 * stance.z_base;
    const bool stands_on_z = stance.z_base > 0.03 * stance.area && stance.z_base > 2 * stance.y_base;
    // If the scene is longest along x, like a vehicle, its other sides give no hint: y is up in most such
    // files.
    const bool longest_z = extent.z >= extent.y && extent.z >= extent.x;
    UpAndFront out = stands_on_z || (longest_z && !stands_on_y) ? z_up : y_up;
    if (dot(stance.net, out.front) < -0.1 * stance.area) out.front = -out.front;
    return out;
}

Vec3 direction_of(Viewpoint viewpoint, const UpAndFront& axes) {
    const auto& [up, front] = axes;
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

View axes_of_view(const UpAndFront& axes, const PictureSettings& settings) {
    const Vec3& up = axes.up;
    View view;
    view.towards = normalised(settings.from.value_or(direction_of(settings.viewpoint, axes)));
    if (settings.turn != 0) view.towards = rotated(view.towards, up, settings.turn);
    Vec3 right = cross(up, view.towards);
    // From straight above or below, the front is at the bottom or the top of the picture.
    if (length(right) < 1e-9)
        right = cross(dot(up, view.towards) > 0 ? -axes.front : axes.front, view.towards);
    view.right = normalised(right);
    view.up = cross(view.towards, view.right);
    return view;
}

/// The box of the scene along the axes of the view.
Box box_along(const View& view, const Scene& scene, const PictureSettings& settings, DrawnVertices& drawn) {
    return seen_box(scene, settings, drawn, [&](const Vec3& p) {
        return Vec3{dot(p, view.right), dot(p, view.up), dot(p, view.towards)};
    });
}

/// The box as View::of maps it at scale 1 in parallel projection, with y down.
Box as_seen(const Box& box) {
    return {{box.min.x, -box.max.y, box.min.z}, {box.max.x, -box.min.y, box.max.z}};
}

/// Magnifies the region around the middle point.
void zoom_in(View& view, const PictureSettings& settings, int width, int height) {
    if (settings.zoom == 1) return;
    const Vec3 canvas_middle{width / 2.0, height / 2.0, 0};
    const Vec3 middle = settings.at ? view.of(*settings.at) : canvas_middle;
    if (!is_finite(middle)) return;
    const auto moved = [&](double& x, double from, double to) { x = (x - from) * settings.zoom + to; };
    for (const auto& [x, ahead, from, to] : {std::tuple{&view.x, &view.ahead_x, middle.x, canvas_middle.x},
                                             std::tuple{&view.y, &view.ahead_y, middle.y, canvas_middle.y}}) {
        moved(*x, from, to);
        moved(*ahead, from, to);
    }
    view.scale *= settings.zoom;
    view.distance *= settings.zoom;
    view.z *= settings.zoom;
}

/// Moves the viewer back until the scene's bounding ball fits into the angle of view.
void stand_back(View& view, double angle, const Box& box) {
    const Vec3 middle = box.centre();
    const double radius = box.diagonal() / 2;
    view.eye = middle;
    view.eye->z += radius > 0 ? radius / sine(angle / 2) : 1;
    view.distance = view.eye->z - middle.z; // the distance in samples, after multiplication by the scale
}

} // namespace

Vec3 View::of(const Vec3& p) const {
    const double a = dot(p, right), b = dot(p, up), c = dot(p, towards);
    if (!eye) return {a * scale + x, -b * scale + y, c * scale + z};
    const double near = distance / (eye->z - c); // samples per unit at this depth
    return {(a - eye->x) * near + x, (eye->y - b) * near + y, distance * (near / scale - 1)};
}

Vec3 View::place(const Vec3& seen) const {
    if (!eye) return seen;
    const double far = distance / (seen.z + distance);
    return {(seen.x - ahead_x) * far, (seen.y - ahead_y) * far, distance * (1 - far)};
}

Vec3 View::to_viewer(const Vec3& place) const {
    if (!eye) return {0, 0, 1};
    return normalised(Vec3{0, 0, distance} - place);
}

Camera camera_of(const Scene& scene, const PictureSettings& settings) {
    DrawnVertices drawn;
    const auto [up, front] = settings.camera ? UpAndFront{settings.camera->up, settings.camera->front}
                                             : up_and_front(scene, settings, drawn);
    return {up, front, box_along(axes_of_view({up, front}, settings), scene, settings, drawn)};
}

View view_of(const Scene& scene, const PictureSettings& settings, int width, int height) {
    const Camera camera = settings.camera ? *settings.camera : camera_of(scene, settings);
    View view = axes_of_view({camera.up, camera.front}, settings);
    const Box& box = camera.seen;
    if (box.empty()) return view;
    view.scale = 1;
    if (settings.perspective > 0) stand_back(view, settings.perspective, box);
    DrawnVertices drawn;
    const Box seen = settings.perspective > 0
                         ? seen_box(scene, settings, drawn, [&](const Vec3& p) { return view.of(p); })
                         : as_seen(box);
    const Vec3 size = seen.extent(), middle = seen.centre();
    const double tallest = std::max(size.x / width, size.y / height);
    view.has_extent = tallest > 0;
    view.scale = std::min(tallest > 0 ? 0.92 / tallest : 1, settings.max_scale * Canvas::samples);
    view.distance *= view.scale;
    view.x = view.ahead_x = width / 2.0 - middle.x * view.scale;
    view.y = view.ahead_y = height / 2.0 - middle.y * view.scale;
    if (!view.eye) view.z = -middle.z * view.scale;
    zoom_in(view, settings, width, height);
    return view;
}

} // namespace facetmill
