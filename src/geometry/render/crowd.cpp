// Detects distant outliers that make most of a scene small in its picture.
#include "geometry/render/render.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// Points of the visible parts in world space; every n-th if there are many.
std::vector<Vec3> some_points(const Scene& scene, const PictureSettings& settings) {
    constexpr std::size_t enough = 200000;
    std::vector<Vec3> points;
    std::size_t count = 0;
    for (const Part& part : scene.parts) count += part.mesh.wedge_count() + part.mesh.corner_count();
    const std::size_t step = 1 + count / enough;
    const auto add = [&](const Part& part, const Vec3& p) {
        if (const Vec3 world = part.transform.point(p); is_finite(world)) points.push_back(world);
    };
    std::size_t at = 0; // counts through all parts, so that small parts are sampled too
    for (const Part& part : scene.parts) {
        if (settings.shows && !settings.shows(part)) continue;
        const Mesh& mesh = part.mesh;
        const bool faces = mesh.face_count() > 0; // isolated vertices of a mesh with faces are not drawn
        for (std::size_t i = 0; i < (faces ? mesh.corner_count() : mesh.vertex_count()); ++i)
            if (at++ % step == 0) add(part, faces ? mesh.point(static_cast<Index>(i)) : mesh.positions[i]);
    }
    return points;
}

/// The box without the outer tenth of the points at either end of each axis.
Box middle_box(std::vector<Vec3>& points) {
    Box box;
    Vec3 low, high;
    const std::size_t tenth = points.size() / 10;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto less = [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
        const auto first = points.begin() + static_cast<std::ptrdiff_t>(tenth),
                   last = points.end() - 1 - (first - points.begin());
        std::nth_element(points.begin(), first, points.end(), less);
        low[axis] = (*first)[axis];
        std::nth_element(points.begin(), last, points.end(), less);
        high[axis] = (*last)[axis];
    }
    box.add(low);
    box.add(high);
    return box;
}

} // namespace

std::string crowd_in_words(const Crowd& crowd) {
    return fmt::format(
        "most of the scene is {:.2g} pixels wide in the picture, because another object is far away",
        crowd.pixels);
}

std::optional<Crowd> crowd_of(const Scene& scene, const PictureSettings& settings) {
    constexpr double small = 0.01; // share of the longer side: the size of an icon
    std::vector<Vec3> points = some_points(scene, settings);
    if (points.empty()) return {};
    const Box box = middle_box(points);
    const double size = box.diagonal(), pixels = size * fitting_scale(scene, settings);
    if (!(size > 0) || !(pixels < small * std::max(settings.width, settings.height))) return {};
    // Half of the shorter side, so that the surroundings are visible, too; at most the largest zoom of
    // pictures.
    const double zoom = std::clamp(std::min(settings.width, settings.height) / (2 * pixels), 1.0, 10000.0);
    return Crowd{box.centre(), pixels, std::floor(zoom)};
}

} // namespace facetmill
