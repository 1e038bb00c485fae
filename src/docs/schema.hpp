#pragma once
// JSON Schemas (2020-12) generated from the stage declarations: of the pipeline language, for editors and
// external validation, and of the report.

#include "base/json.hpp"

namespace facetmill::docs {

/// The whole language: params, stages with all their options, branch, foreach, common keys, report. Every
/// value may also be an expression (${x}). The schema accepts everything that `facetmill check` accepts,
/// except the ratio 1.0, which it cannot distinguish from 1. It accepts more, because only check tests
/// ranges of quantities and names.
Json pipeline_schema();

/// The same schema with at most a single type per form, as strict validators require: {"type": ["a", "b"]}
/// becomes anyOf.
Json with_single_types(Json schema);

/// The schema of info --json: report::info_schema() with the kinds of faces.
Json info_schema();
/// The schema of a run's report: report::schema() with the declared result of each stage.
Json report_schema();

} // namespace facetmill::docs
