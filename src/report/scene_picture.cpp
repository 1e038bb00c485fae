#include "report/scene_picture.hpp"

#include "io/gltf/read/skinned_pose.hpp"
#include "io/images/png.hpp"

namespace facetmill::report {

PictureSettings page_settings() {
    PictureSettings settings;
    settings.coarse_occlusion = true;
    settings.point = 3; // as in separate pictures: single pixels are hardly visible
    return settings;
}

std::string page_text(const Picture& picture) { return io::base64(io::png(picture, io::PngEffort::fast)); }

std::string scene_picture(const Scene& scene, PictureSettings settings, io::MaterialResolver& materials) {
    std::vector<Diagnostic> ignored;
    settings.materials = materials.materials(scene, ignored);
    const auto posed = io::posed(scene);
    return page_text(picture_of(posed ? *posed : scene, settings));
}

std::string small_picture(const Scene& scene, std::vector<Diagnostic>& not_drawn) {
    PictureSettings small = page_settings();
    small.width = 160;
    small.height = 120;
    small.point = 2;
    io::MaterialResolver materials;
    materials.materials(scene, not_drawn); // reports each texture once
    return scene_picture(scene, small, materials);
}

} // namespace facetmill::report
