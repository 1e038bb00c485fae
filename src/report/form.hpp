#pragma once
// The forms that reports have, of a run and of a batch.

#include <string>

namespace facetmill::report {

enum class ReportForm { json, html, junit, text };

/// By the suffix of the report's file: .json, .html, .xml (JUnit) or .txt. Throws usage (E-REPORT) for
/// another.
ReportForm form_of(const std::string& path);

} // namespace facetmill::report
