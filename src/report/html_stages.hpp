#pragma once
// The stages of a run on its page: what each did, its picture beside the one before, and its details.

#include "report/record.hpp"

#include <string>

namespace facetmill::report {

/// A section for each stage; empty when there are no stages.
std::string stage_sections(const RunRecord& record);

/// Rows of a table of two columns, name and value, for what an object holds; objects inside it are written as
/// a.b. Lists of objects are left out.
std::string value_rows(const Json& object);

} // namespace facetmill::report
