#pragma once
// The options of clean and their conversion to settings.

#include "geometry/clean/clean.hpp"
#include "stage/stage.hpp"

namespace facetmill::clean_stage {

struct CleanHoleOptions {
    HoleFill method = HoleFill::minimal;
    std::int64_t max_edges = 0;
    std::optional<Length> max_length;
};

struct CleanComponentOptions {
    std::int64_t min_faces = 0;
    std::optional<Length> min_size;
    std::optional<Ratio> min_area;
    std::int64_t keep = 0;
};

struct CleanOptions {
    Nearness weld = Nearness::exact, stitch = Nearness::off, t_junctions = Nearness::exact;
    bool degenerate = true, duplicates = true, walls = true, non_manifold = true, isolated = true,
         open_components = false, inner_components = false;
    Untangle self_intersections = Untangle::off;
    std::optional<Length> tolerance;
    bool single = false, apart = true, unit_vectors = false;
    std::optional<CleanHoleOptions> holes;
    std::optional<CleanComponentOptions> components;
    bool hidden = false;
    std::optional<Length> gap; ///< of hidden

    /// Whether components may vanish on purpose.
    bool removes_components() const { return components || inner_components || open_components || hidden; }
};

void declare_clean(Declare<CleanOptions>& d);
/// Checks for conflicting options, which the declaration cannot express.
void verify_clean(const CleanOptions& o, const Value& given, Problems& problems);

/// The steps, without their lengths.
[[nodiscard]] CleanSettings clean_steps_of(const CleanOptions& o);
/// Converts lengths from world space to the part's space. If the transform scales, the mean scale is used.
[[nodiscard]] CleanSettings clean_settings(const CleanOptions& o, const Scene& scene, const Part& part,
                                           Context& context);

} // namespace facetmill::clean_stage
