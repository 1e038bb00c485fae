#pragma once
// The declared fields of what a run collects, from which the JSON of reports and its schema come.

#include "options/fields.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// Of a Diagnostic: {id, message, where, hint}.
const Fields& diagnostic_fields();
/// Of a StageRecord, a Check and a RunRecord, as the report has them.
const Fields& stage_fields();
const Fields& check_fields();
const Fields& run_fields();
/// Of a RunRecord: what differs from run to run, and is therefore in no report.
const Fields& timings_fields();

/// [{id, message, where, hint}]
template <class Diagnostics>
Json diagnostics_json(const Diagnostics& diagnostics) {
    Json all = Json::array();
    for (const Diagnostic& d : diagnostics) all.push_back(diagnostic_fields().json(&d));
    return all;
}

} // namespace facetmill::report
