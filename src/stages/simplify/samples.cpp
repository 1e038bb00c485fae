#include "stages/simplify/samples.hpp"

#include <cmath>

namespace facetmill::simplify_stage {

SampledSize sampled_size(const Surface& surface) {
    SampledSize size{0, surface.size()};
    for (std::size_t t = 0; t < surface.size(); ++t) {
        const Vec3& a = surface.point(t, 0);
        const double area = length(cross(surface.point(t, 1) - a, surface.point(t, 2) - a)) / 2;
        if (std::isfinite(area)) size.area += area;
    }
    return size;
}

std::vector<std::size_t> shared_samples(std::size_t all, std::span<const SampledSize> parts) {
    double area = 0;
    double triangles = 0;
    for (const auto& part : parts) {
        area += part.area;
        triangles += static_cast<double>(part.triangles);
    }
    const bool by_area = area > 0 && std::isfinite(area);
    std::vector<std::size_t> shares;
    for (const auto& part : parts) {
        double share = triangles > 0 ? static_cast<double>(part.triangles) / triangles : 0;
        if (by_area) share = share / 2 + part.area / area / 2;
        shares.push_back(static_cast<std::size_t>(std::ceil(share * static_cast<double>(all))));
    }
    return shares;
}

} // namespace facetmill::simplify_stage
