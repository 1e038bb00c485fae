#pragma once
// The options of bake.

#include "stage/stage.hpp"

namespace facetmill::bake_stage {

enum class Facing { automatic, same, any };

struct BakeOptions {
    std::int64_t size = 2048, samples = 1, dilation = 16, occlusion_rays = 64;
    std::optional<PathText> from;
    std::optional<Length> distance, occlusion_distance;
    Facing facing = Facing::automatic;
    std::optional<PathText> height, position, thickness;
};

void declare_bake(Declare<BakeOptions>& d);

} // namespace facetmill::bake_stage
