#pragma once
// The stages of a run on its page: the result of each, its picture next to the previous, and its details.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// A section for each stage; empty when there are no stages.
std::string stage_sections(const RunRecord& record);

/// Rows of a table of two columns, name and value, for the members of an object; nested objects are written
/// as a.b. Lists of objects are omitted.
std::string value_rows(const Json& object);

} // namespace facetmill::report
