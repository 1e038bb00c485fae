#include "geometry/deviation/area_samples.hpp"

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/deviation/deviation.hpp"

#include <algorithm>
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
    : surface_(surface), seed_(seed), start_u_(uniform(hashed(seed, 0))), start_v_(uniform(hashed(seed, 1))),
      firsts_(surface.size() + 1) {
    const std::vector<double> areas = areas_up_to(surface);
    if (areas.empty() || !(areas.back() > 0) || !std::isfinite(areas.back())) return;
    size_ = count;
    area_ = areas.back();
    parallel_for(areas.size() - 1, [&](std::size_t t) { firsts_[t + 1] = count_before(areas[t]); });
    firsts_.back() = size_; // also those that rounding leads past the end; the last need not have an area
}

/// Where in the area the k-th part begins; not before the sample of an earlier one.
double AreaSamples::begin_of(std::size_t k) const {
    return static_cast<double>(k) / static_cast<double>(size_) * area_;
}

double AreaSamples::place_of(std::size_t k) const {
    const double within = uniform(hashed(seed_, k + 2));
    return (static_cast<double>(k) + within) / static_cast<double>(size_) * area_;
}

/// Rounding is monotone, so most are told by their parts alone.
bool AreaSamples::is_before(std::size_t k, double area) const {
    if (begin_of(k) >= area) return false;
    return begin_of(k + 1) < area || place_of(k) < area;
}

/// How many samples lie before the end of so much of the area.
std::size_t AreaSamples::count_before(double area) const {
    if (size_ == 0) return 0;
    std::size_t k = std::min(static_cast<std::size_t>(area / area_ * static_cast<double>(size_)), size_ - 1);
    while (k > 0 && !is_before(k - 1, area)) --k;
    while (k < size_ && is_before(k, area)) ++k;
    return k;
}

std::size_t AreaSamples::triangle_of(std::size_t k) const {
    const auto after = std::upper_bound(firsts_.begin(), firsts_.end(), k);
    return static_cast<std::size_t>(after - firsts_.begin()) - 1;
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
        std::size_t t = points.triangle_of(begin);
        for (std::size_t k = begin; k < end; ++k) {
            while (points.first(t + 1) <= k) ++t;
            samples[k] = {points.point(k, t), static_cast<Index>(t)};
        }
    });
    return samples;
}

} // namespace facetmill
