#pragma once
// The results of a run and its checks in words, shared by the renderers.

#include "base/math/vec.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// The verdict: "passed: all checks held and all outputs were written", "failed with exit code 1: no output
/// was written".
[[nodiscard]] std::string verdict_text(const RunRecord& record);
/// The number of passed checks of a run: "5 of 6".
[[nodiscard]] std::string passed_text(const RunRecord& record);
/// The outcome: "passed", "known", "failed" or "warned".
[[nodiscard]] const char* outcome(const Check& check);
/// The part and the file that the check refers to: "body", "body in a.glb", "a.glb"; empty: the scene.
[[nodiscard]] std::string subject_text(const Check& check);
/// The found value: "12", "true", "mm", "[0, 0, 0] to [1, 1, 1]", "not applicable".
[[nodiscard]] std::string found_text(const Check& check);
/// The distance of a number from its limit: "0.3 to spare (60 % of the limit)", "7 too many"; empty without
/// a limit.
[[nodiscard]] std::string margin_text(const Check& check);
/// A location or a share as text: "face 7 of 'part' at 1 2 3".
[[nodiscard]] std::string evidence_text(const EvidenceEntry& entry);
/// The evidence as text: "12 locations, 2 new, the first face 7 of 'part' at 1 2 3", "part 'wheel' 1200,
/// part 'body' 800"; empty without evidence.
[[nodiscard]] std::string locations_text(const Check& check);
/// The world positions where a failed check fails; empty if it passed or has no positions.
[[nodiscard]] std::vector<Vec3> failing_locations(const Check& check);

} // namespace facetmill::report
