#pragma once
// Holds a scene against assertions: what validate does.

#include "stage/assertions.hpp"
#include "stages/validate/scene_limits.hpp"

#include <filesystem>
#include <optional>

namespace facetmill::validate_stage {

/// What the assertions are about.
enum class Per {
    scene,     ///< sums over the parts, and truths of all parts
    part,      ///< each part for itself
    component, ///< each component of each part, connected through edges
};

struct JudgeSettings {
    Assertions assertions; ///< lengths not yet resolved
    SceneLimits limits;
    Severity severity = Severity::error; ///< of failed checks
    Per per = Per::scene;
    std::optional<std::filesystem::path> baseline = {}; ///< known failures, to read or to write
    bool update_baseline = false;                       ///< write it
    std::optional<std::filesystem::path> mark = {};     ///< a copy with the faces that fail in red, if any do
};

/// What a baseline came to; none without one.
struct ValidateReport {
    std::optional<std::size_t> waived, waived_locations; ///< known failures, and locations of failures
    std::optional<std::size_t> fixed, fixed_locations;   ///< known ones that are no longer there
    bool fails = false;                                  ///< something failed that was not known
};

/// Adds one check to the context for every assertion and thing that it is about, failed ones with evidence:
/// the first locations, with the faces as the part numbers them, and how many there are. Those of the
/// baseline are waived as long as they get no worse. The scene is as before afterwards. Throws usage (E-UNIT)
/// for lengths, missing and malformed for the baseline, output for the copy.
ValidateReport judge(Scene& scene, JudgeSettings settings, Context& context);

} // namespace facetmill::validate_stage
