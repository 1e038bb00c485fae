#pragma once
// JSON Schema (2020-12) of the pipeline language, for editors and for checking files elsewhere.

#include "base/json.hpp"

namespace facetmill::docs {

/// The whole language: params, stages with all their options, branch, foreach, common keys, report. Wherever
/// a value stands, an expression (${x}) may stand too. It accepts what `facetmill check` accepts, and more:
/// ranges, exclusive options and names are judged by check.
Json pipeline_schema();

} // namespace facetmill::docs
