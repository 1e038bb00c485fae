#pragma once
// The stages of a run on its page: the effect of each, its picture next to the previous one, and its details.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// A section for each stage; empty when there are no stages.
[[nodiscard]] std::string stage_sections(const RunRecord& record);

/// Table rows (name, value) for the values of an object; nested objects as a.b. Skips lists of objects.
[[nodiscard]] std::string value_rows(const Json& object);

} // namespace facetmill::report
