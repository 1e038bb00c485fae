#pragma once
// The options of clean, and what they come to.

#include "geometry/clean/clean.hpp"
#include "stage/stage.hpp"

namespace facetmill {

struct CleanHoleOptions {
    HoleFill method = HoleFill::minimal;
    std::int64_t edges = 0;
    std::optional<Length> length;
};

struct CleanComponentOptions {
    std::int64_t faces = 0;
    std::optional<Length> size;
    std::optional<Ratio> area;
    std::int64_t keep = 0;
};

struct CleanOptions {
    Nearness weld = Nearness::exact, stitch = Nearness::off, t_vertices = Nearness::exact;
    bool degenerate = true, duplicates = true, non_manifold = true, isolated = true, shells = false;
    Untangle self_intersections = Untangle::off;
    std::optional<Length> within;
    std::optional<CleanHoleOptions> holes;
    std::optional<CleanComponentOptions> components;
};

void declare_clean(Declare<CleanOptions>& d);
/// What the declaration cannot say: options that do not go together.
void verify_clean(const CleanOptions& o, const Value& given, Problems& problems);

/// Lengths are in the world, meshes in their own space: a transform that stretches does so by its mean.
CleanSettings clean_settings(const CleanOptions& o, const Scene& scene, const Part& part, Context& context);

} // namespace facetmill
