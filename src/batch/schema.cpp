// The JSON Schemas of what a batch writes.

#include "batch/batch.hpp"
#include "report/record_fields.hpp"
#include "report/schema_forms.hpp"

namespace facetmill::batch {

namespace {

using report::closed_object;
using report::list_of;
using report::typed;

Json count_schema(const char* about = nullptr) {
    Json schema = typed("integer", about);
    schema["minimum"] = 0;
    return schema;
}

Json asset_schema() {
    const Json warning = closed_object({{"id", typed("string")}, {"message", typed("string")}});
    return closed_object({{"asset", typed("string", "Its input, or what names its row of the table")},
                          {"verdict", report::choice({"ok", "failed", "interrupted", "not run"})},
                          {"exit_code", typed("integer")},
                          {"faces_in", count_schema("As loaded first")},
                          {"faces_out", count_schema("At the end")},
                          {"bytes", count_schema("Of all outputs, without reports")},
                          {"outputs", list_of(typed("string"), "From the output folder")},
                          {"errors", list_of(report::reference("diagnostic"), "Why it failed")},
                          {"warnings", list_of(warning, "What its run warned of")}});
}

} // namespace

Json summary_schema() {
    Json out = closed_object(
        {{"format", {{"const", 1}}},
         {"tool", closed_object({{"name", {{"const", "facetmill"}}}, {"version", typed("string")}})},
         {"pipeline", typed("string")},
         {"passed", typed("boolean", "All assets are ok, and so is the batch")},
         {"exit_code", typed("integer", "The most severe of all assets")},
         {"counts", closed_object({{"assets", count_schema()},
                                   {"ok", count_schema()},
                                   {"failed", count_schema()},
                                   {"interrupted", count_schema()},
                                   {"not_run", count_schema()}})},
         {"errors", list_of(report::reference("diagnostic"), "Of the batch as a whole")},
         {"assets", list_of(asset_schema(), "The most severe failures first")}});
    out["$schema"] = report::schema_dialect;
    out["title"] = "facetmill batch";
    out["$defs"] = {{"diagnostic", report::diagnostic_fields().schema()}};
    return out;
}

} // namespace facetmill::batch
