#pragma once
// The options of split and their conversion to settings.

#include "geometry/split/split.hpp"
#include "stage/stage.hpp"

namespace facetmill::split_stage {

struct SplitOptions {
    std::optional<SplitMethod> method; ///< if empty: midpoint, or bisect with a target
    std::optional<std::int64_t> grid, passes, max_faces;
    SplitSettings::Cut cut = SplitSettings::Cut::longest_edge;
    std::optional<Length> max_edge;
    std::optional<Angle> min_angle, feature_angle;

    bool has_target() const { return max_edge || min_angle || max_faces; }
    SplitMethod chosen() const {
        return grid ? SplitMethod::grid
                    : method.value_or(has_target() ? SplitMethod::bisect : SplitMethod::midpoint);
    }
};

void declare_split(Declare<SplitOptions>& d);
/// Checks for conflicting options and targets, which the declaration cannot express.
void verify_split(const SplitOptions& o, const Value& given, Problems& problems);

/// The settings shared by all parts, except max_edge, max_faces and the transform.
[[nodiscard]] SplitSettings split_settings(const SplitOptions& o);

} // namespace facetmill::split_stage
