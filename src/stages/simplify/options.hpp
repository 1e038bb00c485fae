#pragma once
// The options of simplify, and the settings that follow from them.

#include "geometry/simplify/simplify.hpp"
#include "stage/options/box.hpp"

namespace facetmill::simplify_stage {

struct LockOptions {
    bool boundary = false, seams = false, group = false;
    std::optional<BoxOption> box;
};

struct ConstraintOptions {
    Angle normal_deviation = Angle::degrees(60);
    std::optional<double> aspect_ratio, roundness;
    std::optional<Length> hausdorff;
};

struct LevelOptions {
    std::vector<Ratio> ratios;
};

struct SimplifyOptions {
    enum class Share { error, equal };
    std::optional<Ratio> ratio;
    std::optional<std::int64_t> faces, vertices;
    std::optional<Length> max_error;
    Share share = Share::error;
    std::optional<Length> max_quadric_error = Length::percent(1, Length::Of::part); ///< none: off
    SimplifySettings settings{}; ///< holds only options that the algorithm uses without conversion
    LockOptions lock;
    Angle feature_angle = Angle::degrees(30);
    std::optional<LevelOptions> lods;
    ConstraintOptions constraints;
    bool measure = true, certify = false;
};

/// Whether the method measures the error that max_quadric_error limits.
bool has_quadrics(const SimplifyOptions& o);
/// Whether several parts share one target and collapse in one order of cost.
bool shares_by_error(const SimplifyOptions& o);

void declare_simplify(Declare<SimplifyOptions>& d);
/// Checks for options that conflict, which the declaration cannot express.
void verify_simplify(const SimplifyOptions& o, const Value& given, Problems& problems);

/// The settings for all parts together. Lengths are unresolved, and the planes of `lock: {box}` are missing.
[[nodiscard]] SimplifySettings simplify_settings(const SimplifyOptions& o);

} // namespace facetmill::simplify_stage
