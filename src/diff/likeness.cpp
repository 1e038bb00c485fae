#include "diff/likeness.hpp"

#include "base/math/portable_math.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "io/gltf/read/skinned_pose.hpp"

#include <utility>

namespace facetmill::report {

namespace {

std::vector<PictureSettings> views_of(const Scene& scene, int pixels) {
    PictureSettings common;
    common.width = common.height = pixels;
    common.edges = EdgeLines::no;
    common.occlusion = false; // it is an estimate from depths, with noise of its own
    std::vector<PictureSettings> all(6, common);
    for (std::size_t i = 0; i < 4; ++i) all[i].turn = static_cast<double>(i) * pi / 2;
    all[4].viewpoint = Viewpoint::top;
    all[5].viewpoint = Viewpoint::bottom;
    for (PictureSettings& view : all) view.camera = camera_of(scene, view);
    return all;
}

std::vector<Picture> pictures_of(const Scene& given, std::vector<PictureSettings> views) {
    const auto posed = io::posed(given);
    const Scene& scene = posed ? *posed : given;
    std::vector<Diagnostic> ignored; // stages that draw or write report missing images
    const auto materials = io::MaterialResolver().materials(scene, ignored);
    std::vector<Picture> all;
    all.reserve(views.size());
    for (PictureSettings& view : views) {
        view.materials = materials;
        all.push_back(picture_of(scene, view));
    }
    return all;
}

struct PixelSum {
    std::uint64_t squares = 0, covered = 0; // below 2^63 for pictures of 8192 pixels a side
};

std::uint64_t square(std::int64_t x) { return static_cast<std::uint64_t>(x * x); }

void add_difference(const Picture& a, const Picture& b, PixelSum& sum) {
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        const std::int64_t alpha_a = a.rgba[i + 3], alpha_b = b.rgba[i + 3];
        if (alpha_a == 0 && alpha_b == 0) continue;
        ++sum.covered;
        const std::int64_t whiter = 255 * (alpha_b - alpha_a); // the background seen through a, less b
        for (std::size_t c = 0; c < 3; ++c) {
            const std::int64_t on_black = a.rgba[i + c] * alpha_a - b.rgba[i + c] * alpha_b;
            sum.squares += (square(on_black) + square(on_black + whiter)) >> 8;
        }
    }
}

} // namespace

Likeness::Likeness(const Scene& scene, int pixels) {
    const auto posed = io::posed(scene);
    settings_ = views_of(posed ? *posed : scene, pixels);
    pictures_ = pictures_of(scene, settings_);
}

double Likeness::difference(const Scene& other) const {
    const std::vector<Picture> pictures = pictures_of(other, settings_);
    PixelSum sum;
    for (std::size_t i = 0; i < pictures.size(); ++i) add_difference(pictures_[i], pictures[i], sum);
    constexpr double full = 6.0 * 255 * 255 * 255 * 255 / 256; // three colours on two backgrounds
    return sum.covered == 0 ? 0 : static_cast<double>(sum.squares) / static_cast<double>(sum.covered) / full;
}

} // namespace facetmill::report
