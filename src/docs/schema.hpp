#pragma once
// JSON Schemas (2020-12) generated from the declarations of the stages: for the pipeline language (for
// editors and other checkers) and for the report.

#include "base/json.hpp"

namespace facetmill::docs {

/// The whole language: params, stages with all their options, branch, foreach, common keys, report. Every
/// value may also be an expression (${x}). The schema accepts everything that `facetmill check` accepts
/// (except the ratio 1.0, which it cannot distinguish from 1), and more: check validates ranges of
/// quantities and names.
[[nodiscard]] Json pipeline_schema();

/// The same schema in which each form has at most one type, as strict validators require: {"type": ["a",
/// "b"]} is written with anyOf.
[[nodiscard]] Json with_single_types(Json schema);

/// The schema of info --json: report::info_schema(), with the kinds of faces.
[[nodiscard]] Json info_schema();
/// The schema of a run's report: report::schema(), with the declared result of each stage.
[[nodiscard]] Json report_schema();

} // namespace facetmill::docs
