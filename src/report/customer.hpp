#pragma once
// Why a model was rejected, in plain words for the person who sent it. It names no stages, options or ids.

#include "report/record.hpp"

namespace facetmill::report {

/// The reason why a run failed: one to three sentences for each of the first reasons. Empty if it passed.
[[nodiscard]] std::string customer_text(const RunRecord& record);
/// The reason why a run could not begin or end.
[[nodiscard]] std::string customer_text(const Diagnostic& error, ErrorKind kind);

} // namespace facetmill::report
