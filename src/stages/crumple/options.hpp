#pragma once
// The options of crumple and their conversion to settings.

#include "geometry/crumple/crumple.hpp"
#include "stage/options/mask.hpp"

namespace facetmill::crumple_stage {

struct CrumpleOptions {
    enum class Intersections { allow, avoid, forbid };

    Length amplitude = Length::percent(0.2);
    std::int64_t grid = 3;
    CrumpleSettings::Direction direction = CrumpleSettings::Direction::free;
    CrumpleSettings::Boundary boundary = CrumpleSettings::Boundary::free;
    std::int64_t seed = 0;
    double truncate = 3;
    bool triangulate = false;
    double frequency = 0;
    std::int64_t octaves = 1;
    double roughness = 0.5;
    Intersections self_intersections = Intersections::allow;
    Caps caps = Caps::fixed;
    std::optional<MaskSettings> mask;
};

void declare_crumple(Declare<CrumpleOptions>& d);
/// Checks options that need a frequency, which the declaration cannot express.
void verify_crumple(const CrumpleOptions& o, const Value& given, Problems& problems);

/// The settings shared by all parts, except amplitude, transform and mask. amplitude: the largest amplitude.
[[nodiscard]] CrumpleSettings crumple_settings(const CrumpleOptions& o, const Scene& scene, double amplitude);

} // namespace facetmill::crumple_stage
