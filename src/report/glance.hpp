#pragma once
// The key results of a run, as plain text for pages and Markdown.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// The bytes of files, and their use.
struct ByteSum {
    std::uint64_t bytes = 0;
    io::ByteKinds kinds;
};
ByteSum sum_of(const std::vector<FileRecord>& files);

/// "12.7 %": relative to the value before; "-" if that is 0.
std::string part_of_before(std::uint64_t before, std::uint64_t after);

/// After the first stage and after the last one that was done; none where none was.
struct FaceCounts {
    std::size_t first = 0, last = 0;
};
std::optional<FaceCounts> face_counts(const RunRecord& record);

/// Warnings of the run and of its stages.
std::size_t warning_count(const RunRecord& record);

/// How far the farthest of the outputs is from what it was made of: "0.1 % of the diagonal, from the scene as
/// loaded; ..."; empty when none was measured.
std::string deviation_text(const RunRecord& record);

} // namespace facetmill::report
