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

// What the declarations of all that is written have in common.

/// The objects of the field are those of a definition of the schema, which also says whether they may be
/// null.
void refer(FieldRef field, const char* definition);

/// {name, version}
struct Tool {};
const Fields& tool_fields();

/// What begins every document: its format, 1.
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
/// Of a Diagnostic or what derives from it.
template <class D>
void declare_diagnostic(DeclareFields<D>& d) {
    d.embed([](const D& it) -> const Diagnostic& { return it; },
            [](DeclareFields<Diagnostic>& all) { all.fields = diagnostic_fields(); });
}

} // namespace facetmill::report
