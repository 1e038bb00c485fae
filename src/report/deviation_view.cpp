#include "report/deviation_view.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/deviation/signed_deviation.hpp"
#include "report/scene_picture.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::report {

namespace {

double limit_of(const std::vector<float>& distances, double most) {
    std::vector<float> sizes(distances.size());
    std::transform(distances.begin(), distances.end(), sizes.begin(), [](float x) { return std::abs(x); });
    if (sizes.empty()) return most;
    std::sort(sizes.begin(), sizes.end());
    const auto within = [&](std::size_t percent) {
        return static_cast<double>(sizes[(sizes.size() - 1) * percent / 100]);
    };
    // A small part, such as a closed cut, may be far beyond most of the surface.
    for (const double limit : {within(99), 4 * within(90)})
        if (limit > 0 && limit < most / 4) return limit;
    return most;
}

std::vector<std::uint64_t> counted_in_bins(const std::vector<float>& distances, double limit) {
    constexpr std::size_t bins = 41; // odd, so that a bin is centred on 0
    std::vector<std::uint64_t> counts(bins);
    for (const double d : distances) {
        const double at = limit > 0 ? (d / limit + 1) / 2 * bins : bins / 2.0;
        ++counts[static_cast<std::size_t>(std::clamp(at, 0.0, bins - 1.0))];
    }
    return counts;
}

void take_pictures(const Scene& scene, PictureSettings settings, const Vec3& normal, bool cut,
                   DeviationView& view) {
    settings.attribute = std::string(distance_attribute);
    settings.range = {ColourRange::Kind::given, -view.limit, view.limit, true};
    settings.edges = EdgeLines::no;
    if (settings.camera)
        settings.camera = camera_of(scene, settings); // uses the same size as in the view from behind
    view.picture = page_text(picture_of(scene, settings));
    settings.turn = pi;
    if (settings.camera) settings.camera = camera_of(scene, settings);
    view.behind = page_text(picture_of(scene, settings));
    settings.turn = 0;
    if (length(normal) > 0 && is_finite(normal)) settings.from = normal;
    if (settings.camera) settings.camera = camera_of(scene, settings);
    settings.zoom = 10;
    settings.at = view.worst;
    settings.marks = {view.worst};
    if (!cut) settings.edges = EdgeLines::all;
    view.close = page_text(picture_of(scene, settings));
}

} // namespace

double colour_limit(const std::vector<float>& distances, double most, double diagonal) {
    constexpr double lost_by_floats = 1e-6; // times the diagonal; smaller distances get no colours
    const double limit = limit_of(distances, most);
    return std::isfinite(diagonal) ? std::max(limit, lost_by_floats * diagonal) : limit;
}

FaceTree tree_of_earlier(const Surface& surface, const Box& bounds) {
    constexpr std::size_t many = 250000; // beyond this, building the tree takes longer than measuring
    return FaceTree::over(surface, bounds,
                          surface.size() < many ? FaceTree::Use::few : FaceTree::Use::coarse);
}

DeviationView deviation_view(const Scene& scene, const EarlierSurface& from,
                             const std::optional<PictureSettings>& pictures) {
    const SignedDeviation d = signed_deviation(scene, from.tree, {.last_cap = from.last_cap});
    DeviationView view;
    view.from = from.name;
    view.unit = scene.unit == Unit::unknown ? "" : to_string(scene.unit);
    view.diagonal = from.diagonal;
    view.points = d.looked_up;
    view.caps = d.caps;
    view.low = d.low;
    view.high = d.high;
    view.mean = d.mean;
    view.rms = d.rms;
    view.worst = d.worst;
    view.worst_distance = d.worst_distance;
    view.limit = colour_limit(d.samples, std::max(-d.low, d.high), view.diagonal);
    view.counts = counted_in_bins(d.samples, view.limit);
    if (pictures && d.any()) take_pictures(d.scene, *pictures, d.worst_normal, d.is_cut, view);
    return view;
}

} // namespace facetmill::report
