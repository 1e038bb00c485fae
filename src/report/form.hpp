#pragma once
// The forms that reports have, of a run and of a batch; the suffix of the file says which.

#include <string>

namespace facetmill::report {

enum class ReportForm { json, html, markdown, junit, text };

/// As help and messages name them.
inline constexpr const char* report_suffixes = ".json, .html, .md, .xml (JUnit) or .txt";

/// By the suffix of the report's file. Throws usage (E-REPORT) for another.
ReportForm form_of(const std::string& path);

} // namespace facetmill::report
