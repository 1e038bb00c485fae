#pragma once
// How many points of each part the deviation is measured at.

#include "mesh/surface.hpp"

#include <span>
#include <vector>

namespace facetmill::simplify_stage {

/// What a part's share of the samples depends on.
struct SampledSize {
    double area = 0;
    std::size_t triangles = 0;
};
SampledSize sampled_size(const Surface& surface);

/// Samples of parts that are measured one by one, so that all together have `all`: half of them go by area,
/// half by the number of triangles (all of them where there is no finite area), rounded up. A single part has
/// all.
std::vector<std::size_t> shared_samples(std::size_t all, std::span<const SampledSize> parts);

} // namespace facetmill::simplify_stage
