#include "diff/pictures.hpp"

#include "base/parallel.hpp"
#include "geometry/spatial/signed_distances.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/looks.hpp"
#include "io/png.hpp"
#include "report/viewer.hpp"

namespace facetmill::report {

namespace {

constexpr std::string_view distance_attribute = "distance";

std::string png_of(const Scene& scene, PictureSettings settings, const std::string& attribute,
                   const std::shared_ptr<const MaterialLooks>& looks) {
    settings.width = 640;
    settings.height = 480;
    settings.attribute = attribute;
    settings.legend = !attribute.empty();
    settings.unit = scene.unit == Unit::unknown || attribute.empty() ? "" : to_string(scene.unit);
    settings.looks = looks;
    return io::base64(io::png(picture_of(scene, settings)));
}

/// The distance of each vertex in world space; of isolated ones, too.
std::vector<float> distances_of(const Part& part, const FaceTree& tree) {
    std::vector<Vec3> points(part.mesh.vertex_count());
    parallel_for(points.size(),
                 [&](std::size_t v) { points[v] = part.transform.point(part.mesh.positions[v]); });
    return signed_distances(tree, points);
}

/// The scene with its distances as an attribute.
Scene with_distances(Scene scene, const FaceTree& from) {
    for (Part& part : scene.parts) {
        part.mesh.drop(distance_attribute, Domain::vertex);
        part.mesh.attributes.push_back({std::string(distance_attribute), Domain::vertex, Role::generic, 1,
                                        false, distances_of(part, from)});
    }
    return scene;
}

std::shared_ptr<const MaterialLooks> looks_of(const Scene& scene) {
    std::vector<Diagnostic> ignored; // a texture that cannot be drawn is none of a comparison's business
    return io::LookReader().looks(scene, ignored);
}

} // namespace

ComparisonPictures comparison_pictures(const Scene& a, const Scene& b, const std::string& name_a,
                                       const std::string& name_b) {
    PictureSettings settings;
    Camera camera = camera_of(a);
    settings.camera = camera;
    camera.seen.add(camera_of(b, settings).seen);
    settings.camera = camera;
    const auto looks_a = looks_of(a), looks_b = looks_of(b);
    ComparisonPictures out{png_of(a, settings, {}, looks_a), png_of(b, settings, {}, looks_b), {}, {}};
    const FaceTree tree(surface_of(a, filled_surface), FaceTree::Use::near);
    if (!tree.empty())
        out.distance = png_of(with_distances(b, tree), settings, std::string(distance_attribute), nullptr);
    ViewedScenes viewed(2);
    viewed.add_before(a, name_a, looks_a);
    viewed.add_after(b, name_b, looks_b, &tree, name_a);
    out.view = viewed.json();
    return out;
}

} // namespace facetmill::report
