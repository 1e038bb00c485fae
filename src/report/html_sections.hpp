#pragma once
// The sections of a run's page. A section without contents is empty.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// The summary: faces, bytes, deviation, checks, warnings, and on request the time.
[[nodiscard]] std::string glance_section(const RunRecord& record, bool with_time);
/// Each failed check with its margin and how to continue, and a table of all checks.
[[nodiscard]] std::string check_section(const RunRecord& record);
/// The outputs: their shape compared with the input, and their deviation from it.
[[nodiscard]] std::string output_sections(const RunRecord& record);
/// The deviation of a scene from an earlier scene: a coloured picture, a scale with a histogram, and the
/// magnified worst location. id: the id of its pictures in the page. whole: the name of the scene whose
/// diagonal is the basis of percentages, if it is not the earlier scene.
[[nodiscard]] std::string deviation_html(const DeviationView& view, const std::string& id,
                                         const std::string& name, const std::string& whole = {});
/// Inputs and outputs: bytes by kind, digests, the results of reading back.
[[nodiscard]] std::string file_sections(const RunRecord& record);
/// Time and memory of each stage.
[[nodiscard]] std::string times_section(const RunRecord& record);
/// The pipeline's original text, and the command that runs it again.
[[nodiscard]] std::string source_section(const RunRecord& record);

} // namespace facetmill::report
