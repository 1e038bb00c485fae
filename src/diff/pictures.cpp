#include "diff/pictures.hpp"

#include "base/text/short_names.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "report/deviation_view.hpp"
#include "report/scene_picture.hpp"
#include "report/viewer.hpp"

namespace facetmill::report {

namespace {

std::string png_of(const Scene& scene, PictureSettings settings,
                   const std::shared_ptr<const ResolvedMaterials>& materials) {
    settings.materials = materials;
    return page_text(picture_of(scene, settings));
}

/// None if the surfaces do not differ.
std::optional<DeviationView> distances_from(const FaceTree& tree, double diagonal, const char* name,
                                            const Scene& scene, const PictureSettings& settings) {
    if (tree.empty()) return {};
    auto view = deviation_view(scene, {name, diagonal, tree}, settings);
    // Rounding errors of 32-bit floats are not visible.
    const bool any = std::abs(view.worst_distance) > 1e-6 * view.diagonal;
    return any ? std::optional(std::move(view)) : std::nullopt;
}

} // namespace

ComparisonPictures comparison_pictures(const Scene& a, const Scene& b, const std::string& name_a,
                                       const std::string& name_b) {
    PictureSettings settings = page_settings();
    settings.width = 640;
    settings.height = 480;
    // Distances use the pose of the pictures.
    const auto posed_a = io::posed(a), posed_b = io::posed(b);
    const Scene &seen_a = posed_a ? *posed_a : a, &seen_b = posed_b ? *posed_b : b;
    Camera camera = camera_of(seen_a);
    settings.camera = camera;
    camera.seen.add(camera_of(seen_b, settings).seen);
    settings.camera = camera;
    ComparisonPictures out;
    const auto looks_a = io::MaterialResolver().materials(a, out.not_drawn);
    const auto looks_b = io::MaterialResolver().materials(b, out.not_drawn);
    out.a = png_of(seen_a, settings, looks_a);
    out.b = png_of(seen_b, settings, looks_b);
    const Surface surface_a = surface_or_points_of(seen_a, filled_surface),
                  surface_b = surface_or_points_of(seen_b, filled_surface);
    const Box box_a = surface_a.bounds(), box_b = surface_b.bounds();
    const FaceTree tree = tree_of_earlier(surface_a, box_a);
    settings.width = 480; // three side by side
    settings.height = 360;
    out.backward = distances_from(tree, box_a.diagonal(), "the first file", seen_b, settings);
    out.forward = distances_from(tree_of_earlier(surface_b, box_b), box_b.diagonal(), "the second file",
                                 seen_a, settings);
    for (auto* view : {&out.backward, &out.forward})
        if (*view) (*view)->posed = posed_a || posed_b;
    if (out.forward) out.forward->diagonal = box_a.diagonal(); // all percentages use the same reference
    ViewedScenes viewed(2);
    const auto [short_a, short_b] = short_names(name_a, name_b);
    viewed.add_before(a, short_a, looks_a);
    viewed.add_after(b, short_b, looks_b, {&tree, short_a});
    out.view = viewed.json();
    return out;
}

} // namespace facetmill::report
