#pragma once
// Checks a scene against assertions for validate.

#include "stage/assertions.hpp"
#include "stages/validate/scene_limits.hpp"

#include <filesystem>
#include <optional>

namespace facetmill::validate_stage {

/// The subjects of the assertions.
enum class Per {
    scene,     ///< numbers are summed over the parts; a property must hold for all parts
    part,      ///< each part separately
    component, ///< each component of each part, connected through edges
};

struct JudgeSettings {
    Assertions assertions; ///< lengths are not resolved yet
    SceneLimits limits;
    Severity severity = Severity::error; ///< the severity of failed checks
    Per per = Per::scene;
    std::optional<std::filesystem::path> baseline = {}; ///< known failures, to read or to write
    bool update_baseline = false;
    std::optional<std::filesystem::path> mark =
        {}; ///< writes a copy with the failing faces in red, if any fail
};

/// The results of the baseline; none without a baseline.
struct ValidateReport {
    std::optional<std::size_t> waived, waived_locations; ///< known failures, and locations of failures
    std::optional<std::size_t> fixed, fixed_locations; ///< known failures and locations that no longer occur
    bool fails = false;                                ///< a check has new failures
};

/// Adds a check to the context for every assertion and subject. Files written from the current scene are read
/// back and judged; if none holds all its parts, the scene itself is judged. Limits of files apply to every
/// file written before the stage, along its branch. Failed checks have evidence: the first locations, with
/// the part's face numbers, and the total. Failures of the baseline are waived while they get no worse. The
/// scene is unchanged afterwards. Throws a usage error (E-UNIT) for lengths, the errors of
/// KnownFailures::read, and an output error for the copy.
[[nodiscard]] ValidateReport judge(Scene& scene, JudgeSettings settings, Context& context);

} // namespace facetmill::validate_stage
