// facetmill schema: prints the published JSON Schemas.

#include "docs/schema.hpp"
#include "batch/batch.hpp"
#include "cli/command.hpp"
#include "diff/comparison.hpp"
#include "diff/folders.hpp"
#include "report/render.hpp"

namespace facetmill::cli {

namespace {

constexpr const char* schema_examples = R"(Examples
  facetmill schema > facetmill.schema.json
  facetmill schema report
  # yaml-language-server: $schema=facetmill.schema.json      (the first line of a pipeline, for editors)
)";

} // namespace

Command schema_command() {
    return {"schema",
            "Prints the JSON Schema of pipelines, reports, batches, timings, info or diff.",
            schema_examples,
            {},
            [](Arguments& arguments, Console&) {
                auto what = std::make_shared<std::string>("pipeline");
                arguments
                    .add("WHAT", what.get(),
                         "pipeline, report, batch, timings, info, diff or diff-folders. Default: pipeline.")
                    .one_of({"pipeline", "report", "batch", "timings", "info", "diff", "diff-folders"});
                return [=](const Invocation&) {
                    const Json schema = *what == "report"         ? docs::report_schema()
                                        : *what == "batch"        ? batch::summary_schema()
                                        : *what == "timings"      ? report::timings_schema()
                                        : *what == "info"         ? docs::info_schema()
                                        : *what == "diff"         ? report::comparison_schema()
                                        : *what == "diff-folders" ? report::folder_comparison_schema()
                                                                  : docs::pipeline_schema();
                    print(docs::with_single_types(schema).dump(2) + "\n");
                    return 0;
                };
            }};
}

} // namespace facetmill::cli
