#include "geometry/deviation/area_samples.hpp"

#include "base/math/random.hpp"
#include "geometry/deviation/deviation.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace facetmill {

namespace {

/// The area up to and including each triangle; triangles that are not finite have none.
std::vector<double> areas_up_to(const Surface& surface) {
    std::vector<double> areas(surface.size());
    parallel_for(areas.size(), [&](std::size_t t) {
        const Vec3& a = surface.point(t, 0);
        const double area = length(cross(surface.point(t, 1) - a, surface.point(t, 2) - a)) / 2;
        areas[t] = std::isfinite(area) ? area : 0;
    });
    double sum = 0;
    for (double& area : areas) area = sum += area;
    return areas;
}

} // namespace

AreaSamples::AreaSamples(const Surface& surface, std::size_t count, std::uint64_t seed)
    : surface_(surface), seed_(seed), start_u_(uniform(hashed(seed, 0))), start_v_(uniform(hashed(seed, 1))) {
    const std::vector<double> areas = areas_up_to(surface);
    if (!areas.empty() && areas.back() > 0 && std::isfinite(areas.back())) place_all(count, areas);
}

/// Sample k has a random position in the k-th part of the area, so positions ascend. Most parts are within
/// one triangle.
void AreaSamples::place_all(std::size_t count, const std::vector<double>& areas) {
    const auto area_at = [&](double part) { return part / static_cast<double>(count) * areas.back(); };
    const auto place_of = [&](std::size_t k) {
        return area_at(static_cast<double>(k) + uniform(hashed(seed_, k + 2)));
    };
    triangles_.resize(count);
    parallel_chunks(count, [&](std::size_t begin, std::size_t end) {
        auto after = std::upper_bound(areas.begin(), areas.end(), place_of(begin));
        for (std::size_t k = begin; k < end; ++k) {
            if (after != areas.end() && !(area_at(static_cast<double>(k + 1)) < *after)) {
                const double place = place_of(k);
                while (after != areas.end() && !(*after > place)) ++after;
            }
            const auto t = static_cast<std::size_t>(after - areas.begin()); // rounding may lead past the end
            triangles_[k] = static_cast<Index>(std::min(t, areas.size() - 1));
        }
    });
}

std::vector<AreaSamples::Run> AreaSamples::runs(std::span<const Index> order) const {
    std::vector<Run> ascending;
    std::vector<std::uint64_t> has(surface_.size() / 64 + 1); // a bit for each triangle with samples
    std::vector<Index> before(has.size()); // the number of runs before each group of 64 triangles
    for (std::size_t k = 0; k < size();) {
        const Index t = triangles_[k];
        const std::size_t begin = k;
        while (k < size() && triangles_[k] == t) ++k;
        ascending.push_back({t, begin, k});
        has[t / 64] |= std::uint64_t{1} << t % 64;
    }
    for (std::size_t i = 1; i < has.size(); ++i)
        before[i] = before[i - 1] + static_cast<Index>(std::popcount(has[i - 1]));
    std::vector<Run> runs;
    runs.reserve(ascending.size());
    for (const Index t : order) {
        const std::uint64_t bit = std::uint64_t{1} << t % 64;
        if ((has[t / 64] & bit) == 0) continue;
        runs.push_back(
            ascending[before[t / 64] + static_cast<std::size_t>(std::popcount(has[t / 64] & (bit - 1)))]);
    }
    return runs;
}

AreaSamples::OnTriangle AreaSamples::on(std::size_t triangle) const {
    OnTriangle on;
    on.corner_ = surface_.point(triangle, 0);
    on.ab_ = surface_.point(triangle, 1) - on.corner_;
    on.ac_ = surface_.point(triangle, 2) - on.corner_;
    on.start_u_ = start_u_;
    on.start_v_ = start_v_;
    return on;
}

std::vector<SurfaceSample> sample_area(const Surface& surface, std::size_t count, std::uint64_t seed) {
    const AreaSamples points(surface, count, seed);
    std::vector<SurfaceSample> samples(points.size());
    parallel_chunks(samples.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) samples[k] = {points.point(k), points.triangle_of(k)};
    });
    return samples;
}

} // namespace facetmill
