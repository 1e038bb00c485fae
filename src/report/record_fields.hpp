#pragma once
// The declared fields of a run's data, from which the JSON of reports and its schema are generated.

#include "options/fields.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// The fields of a Diagnostic: {id, message, where, hint}.
const Fields& diagnostic_fields();
/// The fields of a StageRecord, a Check and a RunRecord in reports.
const Fields& stage_fields();
const Fields& check_fields();
const Fields& run_fields();
/// The fields of a RunRecord that differ between runs, and are therefore in no report.
const Fields& timings_fields();

// Shared by the declarations of all documents.

/// Makes the field's objects refer to a definition of the schema, which also specifies whether they may be
/// null.
void refer(FieldRef field, const char* definition);

/// {name, version}
struct Tool {};
const Fields& tool_fields();

/// The first field of every document: its format, 1.
template <class R>
void declare_format(DeclareFields<R>& d) {
    d.field(
         "format", [](const R&) { return 1; }, "")
        .field()
        .schema = {{"const", 1}};
}
template <class R>
void declare_tool(DeclareFields<R>& d) {
    d.object(
        "tool", [](const R&) { return Tool(); }, "",
        [](DeclareFields<Tool>& t) { t.fields = tool_fields(); });
}
/// The fields of a Diagnostic or a derived type.
template <class D>
void declare_diagnostic(DeclareFields<D>& d) {
    d.embed([](const D& it) -> const Diagnostic& { return it; },
            [](DeclareFields<Diagnostic>& all) { all.fields = diagnostic_fields(); });
}

} // namespace facetmill::report
