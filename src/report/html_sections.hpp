#pragma once
// The sections of a run's page. A section without content is empty.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// The key results: faces, bytes, deviation, checks, warnings, and the time on request.
std::string glance_section(const RunRecord& record, bool with_time);
/// Each check that did not hold, with its margin and how to go on, and a table of all.
std::string check_section(const RunRecord& record);
/// The outputs: the shape next to the input's, and the deviation from it.
std::string output_sections(const RunRecord& record);
/// How far a scene is from an earlier one: a picture in colours, their scale with a histogram, and the worst
/// place magnified. id: of its pictures in the page. whole: whose diagonal the view has, if it is not the
/// earlier one's.
std::string deviation_html(const DeviationView& view, const std::string& id, const std::string& name,
                           const std::string& whole = {});
/// Inputs and outputs: bytes and their use, digests, results of reading back.
std::string file_sections(const RunRecord& record);
/// Time and memory of each stage.
std::string times_section(const RunRecord& record);
/// The pipeline as it was written, and the command that runs it again.
std::string source_section(const RunRecord& record);

} // namespace facetmill::report
