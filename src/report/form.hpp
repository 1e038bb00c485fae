#pragma once
// The forms of reports, of a run and of a batch; the suffix of the file selects the form.

#include <string>

namespace facetmill::report {

enum class ReportForm { json, html, markdown, junit, text };

/// The suffixes in help and messages.
inline constexpr const char* report_suffixes = ".json, .html, .md, .xml (JUnit) or .txt";

/// By the suffix of the report's file. Throws usage (E-REPORT) for another.
ReportForm form_of(const std::string& path);

} // namespace facetmill::report
