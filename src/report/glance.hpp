#pragma once
// The summary at the top of a report, as plain text for pages and Markdown.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// The total bytes of files, by kind.
struct ByteSum {
    std::uint64_t bytes = 0;
    io::ByteKinds kinds;
};
[[nodiscard]] ByteSum sum_of(const std::vector<FileRecord>& files);

/// The share of the size before: "12.7 %", or "-" if that size was zero.
[[nodiscard]] std::string part_of_before(std::uint64_t before, std::uint64_t after);

/// The face counts after the first and after the last completed stage; empty without stages.
struct FaceCounts {
    std::size_t first = 0, last = 0;
};
[[nodiscard]] std::optional<FaceCounts> face_counts(const RunRecord& record);

/// The number of warnings of the run and its stages.
[[nodiscard]] std::size_t warning_count(const RunRecord& record);

/// The largest deviation of the outputs from their references: "0.1 % of the diagonal, from the scene as
/// loaded; ..."; empty without a measurement.
[[nodiscard]] std::string deviation_text(const RunRecord& record);

} // namespace facetmill::report
