#include "diff/pictures.hpp"

#include "base/parallel.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/looks.hpp"
#include "io/png.hpp"

namespace facetmill::report {

namespace {

constexpr std::string_view distance_attribute = "distance";

std::string png_of(const Scene& scene, PictureSettings settings, const std::string& attribute) {
    io::LookReader reader;
    std::vector<Diagnostic> ignored; // a texture that cannot be drawn is none of a comparison's business
    settings.width = 640;
    settings.height = 480;
    settings.attribute = attribute;
    settings.legend = !attribute.empty();
    settings.unit = scene.unit == Unit::unknown || attribute.empty() ? "" : to_string(scene.unit);
    if (attribute.empty()) settings.looks = reader.looks(scene, ignored);
    return io::base64(io::png(picture_of(scene, settings)));
}

/// The distance of each vertex in world space; of isolated ones, too.
std::vector<float> signed_distances(const Part& part, const FaceTree& tree) {
    std::vector<Vec3> points(part.mesh.vertex_count());
    parallel_for(points.size(),
                 [&](std::size_t v) { points[v] = part.transform.point(part.mesh.positions[v]); });
    const auto found = closest_points(tree, points);
    std::vector<float> distances(points.size());
    parallel_for(points.size(), [&](std::size_t v) {
        const Closest& c = found[v];
        if (c.triangle == none) return; // not finite
        const auto& [p, q, r] = tree.triangles[c.triangle];
        const Vec3 normal = cross(q - p, r - p);
        distances[v] = static_cast<float>(dot(points[v] - c.point, normal) < 0 ? -c.distance : c.distance);
    });
    return distances;
}

/// The scene with its distances as an attribute.
Scene with_distances(Scene scene, const Surface& from) {
    const FaceTree tree(from, FaceTree::Use::near);
    for (Part& part : scene.parts) {
        part.mesh.drop(distance_attribute, Domain::vertex);
        part.mesh.attributes.push_back({std::string(distance_attribute), Domain::vertex, Role::generic, 1,
                                        false, signed_distances(part, tree)});
    }
    return scene;
}

} // namespace

ComparisonPictures comparison_pictures(const Scene& a, const Scene& b) {
    PictureSettings settings;
    Camera camera = camera_of(a);
    settings.camera = camera;
    camera.seen.add(camera_of(b, settings).seen);
    settings.camera = camera;
    ComparisonPictures out{png_of(a, settings, {}), png_of(b, settings, {}), {}};
    const Surface surface = surface_of(a, filled_surface);
    if (surface.size() > 0)
        out.distance = png_of(with_distances(b, surface), settings, std::string(distance_attribute));
    return out;
}

} // namespace facetmill::report
