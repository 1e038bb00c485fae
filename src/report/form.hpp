#pragma once
// The formats of reports of runs and batches; the file suffix selects the format.

#include <string>

namespace facetmill::report {

enum class ReportForm { json, html, markdown, junit, text };

/// The suffixes, as in help and messages.
inline constexpr const char* report_suffixes = ".json, .html, .md, .xml (JUnit) or .txt";

/// The format for the report file's suffix. Throws a usage error (E-REPORT) for another suffix.
ReportForm form_of(const std::string& path);

} // namespace facetmill::report
