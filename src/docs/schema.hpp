#pragma once
// JSON Schemas (2020-12) that come from the declarations of the stages: of the pipeline language, for editors
// and for checking files elsewhere, and of the report.

#include "base/json.hpp"

namespace facetmill::docs {

/// The whole language: params, stages with all their options, branch, foreach, common keys, report. Wherever
/// a value stands, an expression (${x}) may stand too. It accepts what `facetmill check` accepts (but for the
/// ratio 1.0, which it cannot tell from 1), and more: ranges of quantities and names are judged by check.
Json pipeline_schema();

/// The same schema in which each form has one type at most, as strict validators want it: {"type": ["a",
/// "b"]} is written with anyOf.
Json with_single_types(Json schema);

/// What info --json prints: that of report::info_schema(), with the kinds of faces.
Json info_schema();
/// The report of a run: that of report::schema(), with the result of each stage that was done as its
/// declaration says.
Json report_schema();

} // namespace facetmill::docs
